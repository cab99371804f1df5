/// \file
/// Cells in which paints change so much over a pixel that quarters (docs/coverage.md) do not suffice. Shaders
/// have nothing finer, the scanner does: their pixels are handed over, as those of crowded cells are.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "asset/planar_map.hpp"
#include "asset/steepness.hpp"

namespace vtm::gl {

/// What shaders still draw, of a change over `RoughCells::pixel`. A patch serves an octave, and that is the
/// diagonal of its largest pixel: pixels themselves are 1.4 to 2.8 times as small. Under an edge a sixteenth
/// of a change is left, of layers that change together the square's 24th: 2/255, and as much from other
/// causes.
inline constexpr float maxCutChange = 40.0f / 255, maxCutVariation = 0.4f, maxWholeChange = 120.0f / 255;

struct RoughCells {
    std::span<const asset::PaintChange> changes;  ///< by paint; empty: none are
    float pixel = 0;                              ///< the longest step of a pixel, in the picture

    bool mayBe(std::uint32_t paint, const std::vector<asset::PlanarPiece>& pieces,
               std::span<const std::uint32_t> list) const {
        if (changes.empty())
            return false;
        if (isRough(paint, !list.empty()))
            return true;
        for (const std::uint32_t i : list)
            if (isRough(pieces[i].left, true) || isRough(pieces[i].right, true))
                return true;
        return false;
    }

private:
    /// Hard stops and blend modes have no bound; they count by what they change in all.
    bool isRough(std::uint32_t paint, bool isCut) const {
        const asset::PaintChange& change = changes[paint];
        const float whole = std::isfinite(change.roughness) ? change.roughness : change.variation;
        const float cut = std::isfinite(change.steepness) ? change.steepness : 0;
        return whole * pixel > maxWholeChange ||
               (isCut && (cut * pixel > maxCutChange || change.variation * pixel > maxCutVariation));
    }
};

}  // namespace vtm::gl
