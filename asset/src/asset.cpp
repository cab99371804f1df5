#include "asset/asset.hpp"

namespace vtm::asset {

namespace {

template <class Record>
std::vector<Record> copied(std::span<const Record> records) {
    return {records.begin(), records.end()};
}

}  // namespace

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
