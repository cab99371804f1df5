/// \file
/// A pattern's tiles and how many there are.
#pragma once

#include <cmath>
#include <unordered_map>

#include <glm/common.hpp>

#include <vtm/scene/scene.hpp>
#include "geometry/box.hpp"

namespace vtm::compiler {

/// Tiles (x, y) with first <= (x, y) <= last: whole numbers, of any size.
struct TileRange {
    glm::dvec2 first, last;

    double count() const { return (last.x - first.x + 1) * (last.y - first.y + 1); }
};

/// Those that meet a box of the pattern's space, which must not be empty, in more than a millionth of the
/// box.
inline TileRange tilesIn(const geometry::Box& box, const scene::Pattern& pattern) {
    constexpr double millionth = 0x1p-20;
    const glm::dvec2 period = pattern.max - pattern.min, slack = millionth * (box.max - box.min);
    const glm::dvec2 first = glm::floor((box.min + slack - pattern.min) / period),
                     end = glm::ceil((box.max - slack - pattern.min) / period);
    return {first, glm::max(first, end - 1.0)};
}

/// What one tile holds, of patterns in it and in these too.
struct TileContent {
    double tiles = 0;     ///< of patterns in it; a fill of more than maxTilesInTile is one: an image
    double segments = 0;  ///< of outlines, about: a line is one, a curve four, a stroke has twice as many
};

class TileCounter {
public:
    TileContent inOneTile(const scene::Pattern& pattern);

private:
    TileContent in(const scene::NodeList& nodes, const geometry::Box& tile);
    TileContent in(const scene::Node& node, const geometry::Box& tile);
    TileContent in(const scene::Item& item, const geometry::Box& tile);

    std::unordered_map<const scene::Group*, TileContent> known_;
};

}  // namespace vtm::compiler
