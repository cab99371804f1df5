#include "asset/asset.hpp"

#include <algorithm>

namespace vtm::asset {

namespace {

template <class Record>
std::vector<Record> copied(std::span<const Record> records) {
    return {records.begin(), records.end()};
}

}  // namespace

bool isSumOfMaps(const AssetView& asset) {
    return asset.mode == Mode::Exact && std::ranges::all_of(asset.commands, [](const Command& command) {
               return command.kind == Command::Kind::DrawMap;
           });
}

Asset toAsset(const AssetView& view) {
    return {.width = view.width,
            .height = view.height,
            .mode = view.mode,
            .maps = copied(view.maps),
            .commands = copied(view.commands),
            .nodes = copied(view.nodes),
            .leaves = copied(view.leaves),
            .pieces = copied(view.pieces),
            .paints = copied(view.paints),
            .data = copied(view.data),
            .images = copied(view.images),
            .materials = copied(view.materials),
            .fallbackLeaves = view.fallbackLeaves,
            .prefilter = {view.prefilter.size, copied(view.prefilter.texels)}};
}

}  // namespace vtm::asset
