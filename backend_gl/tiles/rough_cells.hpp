/// \file
/// Cells in which paints change so much over a pixel that quarters (docs/coverage.md) do not suffice. Shaders
/// have nothing finer, the scanner does: their pixels are handed over, as those of crowded cells are.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "raster/planar_map.hpp"
#include "raster/steepness.hpp"

namespace vtm::gl {

/// What shaders still draw, of a change over PixelsNear::pixel. A tile serves an octave, and that is the
/// diagonal of its largest pixel: pixels themselves are 1.4 to 2.8 times as small. Under an edge a sixteenth
/// of a change is left, of layers that change together the square's 24th: 2/255, and as much from other
/// causes.
inline constexpr float maxCutChange = 40.0f / 255, maxCutVariation = 0.4f, maxWholeChange = 120.0f / 255;
/// Of a hard stop under an edge a tenth is left, whatever a pixel's size, and of two that meet in a pixel
/// what NearChange says.
inline constexpr float maxCutJump = 24.0f / 255, maxJoint = 2.0f / 255;

class RoughCells {
public:
    /// None are.
    RoughCells() = default;
    /// `changes`: by paint. All must outlive it.
    RoughCells(const asset::AssetView& asset, std::span<const asset::PaintChange> changes)
        : asset_(&asset), changes_(changes) {}

    /// A cell's, with the pieces that may cut its pixels.
    bool mayBe(const asset::PixelsNear& pixels, std::uint32_t paint,
               const std::vector<asset::PlanarPiece>& pieces, std::span<const std::uint32_t> list) const {
        if (changes_.empty())
            return false;
        if (isRough(pixels, paint, !list.empty()))
            return true;
        std::uint32_t known[2]{paint, paint};  // mostly pieces have the same paints beside them
        for (const std::uint32_t i : list)
            for (const std::uint32_t beside : {pieces[i].left, pieces[i].right}) {
                if (beside == known[0] || beside == known[1])
                    continue;
                if (isRough(pixels, beside, true))
                    return true;
                known[0] = std::exchange(known[1], beside);
            }
        return false;
    }

private:
    /// What changes little anywhere is not looked for in the cell.
    bool isRough(const asset::PixelsNear& pixels, std::uint32_t paint, bool isCut) const {
        const asset::PaintChange& change = changes_[paint];
        const auto pixel = float(pixels.pixel);
        const bool whole = change.roughness * pixel > maxWholeChange;
        const bool cut =
            isCut && (change.steepness * pixel > maxCutChange || change.variation * pixel > maxCutVariation);
        if (!whole && !cut)
            return false;
        const asset::NearChange near = asset::changeNear(*asset_, paint, pixels);
        if (cut && near.sum > (std::isfinite(change.steepness) ? maxCutChange : maxCutJump))
            return true;
        return whole &&
               (near.sum > maxWholeChange || (!std::isfinite(change.roughness) && near.joint > maxJoint));
    }

    const asset::AssetView* asset_ = nullptr;
    std::span<const asset::PaintChange> changes_;
};

}  // namespace vtm::gl
