#include "bench/src/fragment_cost.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "asset/walk.hpp"

namespace vtm::bench {
namespace {

/// The part of [first, first + 1] / 4^level of the map's side that is inside the picture, as a share of the
/// picture.
double shareInside(std::uint32_t first, unsigned level, double picture) {
    const double side = std::ldexp(1.0, -2 * int(level));
    const double from = first * side, to = std::min(from + side, picture);
    return std::max(0.0, to - from) / picture;
}

}  // namespace

SquareFigures squareFigures(const asset::Asset& asset) {
    SquareFigures figures;
    const asset::Map& map = asset.maps.at(0);
    const double width = asset.width / map.side, height = asset.height / map.side;
    asset::walk(asset, map.root, [&](asset::Cell cell, asset::Entry entry) {
        const double area = shareInside(cell.x, cell.level, width) * shareInside(cell.y, cell.level, height);
        if (area <= 0)
            return;
        ++figures.squares[cell.level];
        double cost = lookupCost;
        if (entry.kind() == asset::Entry::Kind::Leaf) {
            ++figures.leaves[cell.level];
            cost += leafCost + asset.leaves[entry.payload()].pieceCount * pieceCost;
        }
        figures.fragmentCost += area * cost;
    });
    return figures;
}

unsigned levelHolding(const SquareFigures& figures, double share) {
    const std::size_t all = std::accumulate(figures.leaves.begin(), figures.leaves.end(), std::size_t{0});
    std::size_t so = 0;
    for (unsigned level = 0; level <= asset::maxLevel; ++level) {
        so += figures.leaves[level];
        if (double(so) >= share * double(all))
            return level;
    }
    return asset::maxLevel;
}

}  // namespace vtm::bench
