#include <vtm/raster/paint_at.hpp>

#include <algorithm>
#include <span>
#include <stdexcept>
#include <vector>

#include <glm/matrix.hpp>

#include "asset/instances.hpp"
#include "asset/walk.hpp"
#include "raster/planar_map.hpp"

namespace vtm::asset {

namespace {

using glm::dvec2;

/// On the left border of a leaf, at a height in leaf coordinates. A point between two stretches belongs to
/// the upper one, as rows do in addChanges.
std::uint32_t paintOnLeft(const Leaf& leaf, std::span<const Piece> pieces, double y) {
    std::vector<Change> changes;
    const auto add = [&](const std::array<std::uint16_t, 2>& p, std::uint32_t before, std::uint32_t after) {
        if (sideOf(p) == 3)
            changes.push_back({leafExtent - p[1], before, after});
    };
    // At an end B the region on the piece's right lies before it, seen along the side, and the one on its
    // left behind.
    for (const Piece& piece : pieces) {
        add(piece.a, piece.left, piece.right);
        add(piece.b, piece.right, piece.left);
    }
    std::ranges::sort(changes, {}, &Change::at);
    const double fromTop = leafExtent - y;
    std::uint32_t paint = leaf.corners[3];
    forEachStretch(paint, changes, leafExtent, [&](std::uint32_t from, std::uint32_t to, std::uint32_t here) {
        if (from < fromTop && fromTop <= to)
            paint = here;
    });
    return paint;
}

std::uint32_t paintInLeaf(const AssetView& asset, const Leaf& leaf, dvec2 point) {
    const std::span<const Piece> pieces = asset.pieces.subspan(leaf.firstPiece, leaf.pieceCount);
    point = belowTop(point, leafExtent);
    std::vector<Change> changes;
    for (const Piece& piece : pieces)
        addChanges(planarPiece(piece), point, changes);
    return paintBehind(paintOnLeft(leaf, pieces, point.y), changes);
}

/// Of the map alone; p in [0, 1]² of its square.
std::uint32_t paintInMap(const AssetView& asset, const Map& map, dvec2 p) {
    const auto [cell, entry, within] = squareAt(asset, map.root, p);
    return entry.kind() == Entry::Kind::Solid
               ? entry.payload()
               : paintInLeaf(asset, asset.leaves[entry.payload()], within * double(leafExtent));
}

/// Each placed map that holds the point puts a paint in place of its ground, which is the paint of the map
/// around or of another one that lies around it.
std::uint32_t paintInMaps(const AssetView& asset, const Map& map, dvec2 p) {
    const dvec2 point = placeOf(map)(p);
    std::vector<Change> changes;
    forEachMap(asset, map, [&](const PlacedMap& placed) {
        const dvec2 q = glm::inverse(placed.toPicture.linear) * (point - placed.toPicture.offset);
        if (!(q.x >= 0 && q.y >= 0 && q.x <= 1 && q.y <= 1))
            return false;
        if (const std::uint32_t paint = placed.paints(paintInMap(asset, placed.map, q));
            paint != placed.paints.ground())
            changes.push_back({0, placed.paints.ground(), paint});
        return true;
    });
    return paintBehind(0, changes);
}

}  // namespace

std::uint32_t paintAt(const AssetView& asset, dvec2 point) {
    if (!isSumOfMaps(asset))
        throw std::invalid_argument("an asset of compat mode has no regions to find a point in");
    for (const Command& command : asset.commands) {
        const Map& map = asset.maps[command.map];
        const dvec2 p = (point - dvec2(map.x, map.y)) / map.side;
        if (!(p.x >= 0 && p.y >= 0 && p.x <= 1 && p.y <= 1))
            continue;
        return map.instances == 0 ? paintInMap(asset, map, p) : paintInMaps(asset, map, p);
    }
    return 0;
}

}  // namespace vtm::asset
