/// \file
/// A mask of the paper mode as the textures of paper_pattern_fragment.glsl.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "paper/model.hpp"

namespace vtm::paper {

using PlaceTexel = std::uint32_t;
using CellTexel = std::array<float, 4>;

template <class Texel>
struct Texels {
    std::size_t width = 0, height = 0;
    std::vector<Texel> values;

    Texels(std::size_t w, std::size_t h) : width(w), height(h), values(w * h) {}
    void growTo(std::size_t h) {
        height = std::max(height, h);
        values.resize(width * height);
    }
    Texel& at(std::size_t x, std::size_t y) { return values[y * width + x]; }
    std::size_t bytes() const { return values.size() * sizeof(Texel); }
};

struct PatternTables {
    Texels<PlaceTexel> places;
    Texels<CellTexel> cells;
};

/// Levels of a mask's tree below its root.
unsigned patternDepth(const Mask& mask);

/// A 16-tree of one depth everywhere, as the paper's, so that nothing has to be asked on the way down. What
/// is the same over a larger square has nodes there whose children are all alike; those of no boundary are
/// shared. `depth`: at least 1 and patternDepth.
PatternTables treeTables(const Mask& mask, unsigned depth);

/// A place and room for a cell for each of the finest squares, whether or not it has a boundary. Throws
/// GlError where that is larger than a texture may be.
PatternTables gridTables(const Mask& mask, unsigned depth);

}  // namespace vtm::paper
