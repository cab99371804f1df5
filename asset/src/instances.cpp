#include "asset/instances.hpp"

#include <algorithm>

#include "asset/walk.hpp"

namespace vtm::asset {

std::vector<std::uint32_t> largestPaints(const AssetView& asset) {
    std::vector<std::uint32_t> largest(asset.maps.size());
    for (std::size_t i = asset.maps.size(); i-- > 0;) {  // maps inside have larger indices
        const auto include = [&](std::uint32_t paint) { largest[i] = std::max(largest[i], paint); };
        walk(asset, asset.maps[i].root, [&](Cell, Entry entry) {
            if (entry.kind() == Entry::Kind::Solid)
                return include(entry.payload());
            const Leaf& leaf = asset.leaves[entry.payload()];
            std::ranges::for_each(leaf.corners, include);
            for (const Piece& piece : asset.pieces.subspan(leaf.firstPiece, leaf.pieceCount)) {
                include(piece.left);
                include(piece.right);
            }
        });
        forEachInstance(asset, asset.maps[i], [&](const Instance& instance) {
            const Symbol& symbol = asset.symbols[instance.symbol()];
            include(symbol.ground);
            std::ranges::for_each(asset.palettes.subspan(symbol.palette, largest[symbol.map]), include);
        });
    }
    return largest;
}

std::vector<unsigned> mapDepths(const AssetView& asset) {
    std::vector<unsigned> depths(asset.maps.size(), 1);
    for (std::size_t i = asset.maps.size(); i-- > 0;)
        forEachInstance(asset, asset.maps[i], [&](const Instance& instance) {
            depths[i] = std::max(depths[i], depths[asset.symbols[instance.symbol()].map] + 1);
        });
    return depths;
}

}  // namespace vtm::asset
