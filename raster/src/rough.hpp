/// \file
/// Rough pixels: those in which paints change so much that the colours of quarters (docs/coverage.md) do not
/// suffice. They are drawn finer, as pixels of a view that is `finerSide` times as large, and averaged; what
/// of these is rough is drawn finer again.
#pragma once

#include <algorithm>
#include <span>

#include <vtm/asset/asset.hpp>
#include <vtm/raster/view.hpp>
#include "raster/src/float4.hpp"
#include "raster/steepness.hpp"

namespace vtm::asset {

/// Rough pixels are drawn so many times as fine, a side.
inline constexpr int finerSide = 4;
/// As long as the whole view, drawn as fine, would have no longer side: what a view can cost is bounded.
inline constexpr int maxFinerSide = 8192;
inline constexpr int maxFinerLevels = 3;
/// Few of the finer pixels are rough, and their errors differ in sign: each may be off by so many times more.
inline constexpr float finerTolerance = 3;

/// How many times over rough pixels of a view may be drawn finer. Materials are asked for at the places that
/// shaders ask them for, and no others.
inline int finerLevels(const AssetView& asset, const View& view) {
    int levels = 0;
    if (!asset.materials.empty())
        return levels;
    for (int side = std::max(view.width, view.height) * finerSide;
         levels < maxFinerLevels && side <= maxFinerSide; side *= finerSide)
        ++levels;
    return levels;
}

/// Colours in the middles of a pixel's quarters.
using QuarterColors = std::span<const Float4, 4>;

inline Float4 meanOf(QuarterColors q) { return 0.25f * (q[0] + q[1] + q[2] + q[3]); }

/// A pixel that is cut is rough if its quarters differ by more. A part of a quarter is off by at most a
/// sixteenth of what the colour changes by over the pixel, which is about twice the difference: by 1.5/255.
inline constexpr float maxQuarterRange = 12.0f / 255;
/// Or if its paint varies by more over it: quarters that hold a rise and a fall may have one colour.
inline constexpr float maxCutVariation = 0.5f;
/// One of a rough paint that is not cut is rough if the quarters' mean is so far from the pixel's own colour,
/// which is then off by about 4/3 of that; or if the quarters differ by so much, since a jump between
/// points that nobody asked for shows in them only; or if it varies by more, as above.
inline constexpr float maxMeanDifference = 0.75f / 255, maxWholeRange = 24.0f / 255, maxWholeVariation = 1;

/// Of a paint whose layers jump where no stop tells: also if one of its corners differs by so much, since a
/// jump may pass between the middle and a corner.
inline constexpr float maxCornerDifference = 24.0f / 255;

/// The largest difference of a channel.
inline float rangeOf(QuarterColors q) {
    float range = 0;
    for (int c = 0; c < 4; ++c) {
        const auto [min, max] = std::minmax({q[0][c], q[1][c], q[2][c], q[3][c]});
        range = std::max(range, max - min);
    }
    return range;
}

/// When pixels of a paint are rough.
struct RoughBounds {
    float pixel;  ///< a pixel's longest step, in the picture
    float times;  ///< of the bounds above

    /// Whether pixels may be that no edge cuts.
    bool mayBeRough(const PaintChange& paint) const {
        return paint.roughness * pixel > float(minRoughChange);
    }
    /// By what it changes by near them. Two layers with stops at one place, of which each changes by half of
    /// this, are off by a fourth of the product: 0.4/255.
    bool mayBeRoughNear(const PaintChange& near) const {
        return near.roughness * pixel > 0.5f * float(minRoughChange);
    }
    bool isRoughCut(const PaintChange& paint, QuarterColors q) const {
        return paint.variation * pixel > times * maxCutVariation || rangeOf(q) > times * maxQuarterRange;
    }
    bool isRoughCorner(Float4 corner, Float4 color) const {
        return largest(corner - color) > times * maxCornerDifference;
    }
    bool isRoughWhole(const PaintChange& paint, QuarterColors q, Float4 color) const {
        return paint.variation * pixel > times * maxWholeVariation || rangeOf(q) > times * maxWholeRange ||
               largest(meanOf(q) - color) > times * maxMeanDifference;
    }
};

/// `minSteep`: minSteepness() of the view.
inline RoughBounds roughBounds(float minSteep, float times) {
    return {float(minSteepChange) / minSteep, times};
}

}  // namespace vtm::asset
