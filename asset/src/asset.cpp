#include <vtm/asset/asset.hpp>

#include <algorithm>

#include "asset/records.hpp"

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

std::vector<bool> imagesWithLevels(const AssetView& asset) {
    std::vector<bool> wanted(asset.images.size());
    for (const Paint& paint : asset.paints) {
        if (!isProgram(paint))
            continue;
        for (std::uint32_t i = paint[0]; i < paint[0] + paint[1]; ++i) {
            const auto in = recordAt<Instruction>(asset.data, i);
            if (in.op != Op::Image)
                continue;
            const auto fill = recordAt<ImageFill>(asset.data, in.argument);
            if (fill.filter >= ImageFilter::Trilinear)
                wanted[fill.image] = true;
        }
    }
    return wanted;
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
            .prefilter = {view.prefilter.size, copied(view.prefilter.texels)},
            .finestPixel = view.finestPixel};
}

}  // namespace vtm::asset
