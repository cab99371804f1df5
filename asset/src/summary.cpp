#include <algorithm>
#include <set>

#include <vtm/asset/asset.hpp>
#include "asset/walk.hpp"

namespace vtm::asset {

namespace {

std::size_t uploadedBytes(const AssetView& asset) {
    std::size_t bytes = asset.nodes.size() * sizeof(Node) + asset.leaves.size() * sizeof(Leaf) +
                        asset.pieces.size() * sizeof(Piece) + asset.paints.size() * sizeof(Paint) +
                        asset.data.size() * sizeof(Texel);
    for (const image::Bitmap& bitmap : asset.images)
        bytes += bitmap.rgba.size();
    return bytes;
}

}  // namespace

Summary summarize(const AssetView& asset) {
    Summary summary;
    summary.bytes = uploadedBytes(asset);
    summary.prefilterBytes = asset.prefilter.texels.size_bytes();
    summary.leaves = asset.leaves.size();
    summary.pieces = asset.pieces.size();
    summary.regions = std::set<Paint>(asset.paints.begin(), asset.paints.end()).size();
    for (const Map& map : asset.maps)
        walk(asset, map.root, [&](Cell cell, Entry entry) {
            summary.maxDepth = std::max(summary.maxDepth, cell.level);
            summary.solids += entry.kind() == Entry::Kind::Solid;
        });
    return summary;
}

}  // namespace vtm::asset
