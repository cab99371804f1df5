/// \file
/// What commands do to the stack of pictures.
#pragma once

#include <vtm/asset/asset.hpp>

namespace vtm::asset {

/// How many more pictures are on the stack after a command of the asset.
inline int picturesPushed(const AssetView& asset, const Command& command) {
    switch (command.kind) {
        case Command::Kind::DrawMap:
        case Command::Kind::FillMask:
        case Command::Kind::ClipMask:
            return 0;
        case Command::Kind::Push:
        case Command::Kind::PushInput:
            return 1;
        case Command::Kind::Filter:
            return 1 - int(asset.filters[command.map].pictures);
        default:
            return -1;
    }
}

}  // namespace vtm::asset
