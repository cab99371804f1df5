/// \file
/// A pattern's tiles and how many there are.
#pragma once

#include <cmath>
#include <unordered_map>
#include <utility>
#include <vector>

#include <glm/common.hpp>

#include <vtm/scene/scene.hpp>
#include "geometry/box.hpp"

namespace vtm::compiler {

/// Tiles (x, y) with first <= (x, y) <= last: whole numbers, of any size.
struct TileRange {
    glm::dvec2 first, last;

    double count() const { return (last.x - first.x + 1) * (last.y - first.y + 1); }
    /// Whether its numbers are so large that they cannot be counted up, though the tiles are not so many.
    bool isFarAway() const {
        constexpr double uncountable = 0x1p50, manyTimes = 1024;
        const glm::dvec2 number = glm::max(glm::abs(first), glm::abs(last)), tiles = last - first + 1.0;
        const auto isFar = [](double n, double count) { return n > uncountable && n > manyTimes * count; };
        return isFar(number.x, tiles.x) || isFar(number.y, tiles.y);
    }
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

/// Of a tile, in the space that `toOutside` leads to.
double longerSideOf(const scene::Pattern& pattern, const scene::Affine& toOutside);
/// Whether a tile is much longer than a box in the space that `toOutside` leads to. Then its content is not
/// worth making as a whole.
bool isFarLargerThan(const geometry::Box& outside, const scene::Pattern& pattern,
                     const scene::Affine& toOutside);

/// Tiles [first, end) of a row.
struct TileSpan {
    int first = 0, end = 0;

    bool holds(int x) const { return x >= first && x < end; }
};

/// Those that are not to the left or right of all of a shape in their rows, by row; rows and tiles count from
/// range.first. The range must have fewer than 2^31 along each axis.
class TileSpans {
public:
    TileSpans(const TileRange& range, const scene::Pattern& pattern);
    /// A part of the shape's outline, in the pattern's space; `slack`: it may be so far off.
    void add(glm::dvec2 a, glm::dvec2 b, glm::dvec2 slack);
    std::vector<TileSpan> take() { return std::move(rows_); }

private:
    const glm::dvec2 corner_, period_, count_;
    std::vector<TileSpan> rows_;
};
/// All of them.
std::vector<TileSpan> allOf(const TileRange& range);

/// What one tile holds, of patterns in it and in these too.
struct TileContent {
    double tiles = 0;     ///< of patterns in it; a fill of more than maxTilesInTile is one: an image
    double segments = 0;  ///< of outlines, about: a line is one, a curve four, a stroke has twice as many
    /// All paints are colours, or patterns of such whose tiles are not far larger than the tile.
    bool isOfColors = true;
    bool reachesAcross = false;  ///< a shape reaches from a border to the one opposite to it
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
