#include "bench/measure/fragment_cost.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "asset/walk.hpp"

namespace vtm::bench {
namespace {

/// Length of [first, first + 1] · side inside [0, picture].
double lengthInside(std::uint32_t first, double side, double picture) {
    return std::max(0.0, std::min((first + 1) * side, picture) - first * side);
}

}  // namespace

SquareFigures squareFigures(const asset::Asset& asset) {
    SquareFigures figures;
    const asset::Map& map = asset.maps.at(0);
    const double zoom = compiler::CostModel::nominalPixels / std::max(asset.width, asset.height);
    const double width = asset.width * zoom, height = asset.height * zoom;
    double nanoseconds = 0;
    asset::walk(asset, map.root, [&](asset::Cell cell, asset::Entry entry) {
        const double side = std::ldexp(map.side * zoom, -2 * int(cell.level));
        const double w = lengthInside(cell.x, side, width), h = lengthInside(cell.y, side, height);
        if (w <= 0 || h <= 0)
            return;
        ++figures.squares[cell.level];
        double cost = solidCost;
        if (entry.kind() == asset::Entry::Kind::Leaf) {
            ++figures.leaves[cell.level];
            cost = leafCost + asset.leaves[entry.payload()].pieceCount * pieceCost;
        }
        nanoseconds += (w + 1) * (h + 1) * cost;
    });
    figures.fragmentCost = nanoseconds / (width * height);
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
