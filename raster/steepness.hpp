/// \file
/// How fast paints change over the picture. Where a paint is steep within a pixel, the region's part of a
/// pixel on an edge has not the mean that the whole pixel has, and engines ask for that of its quarters
/// (docs/coverage.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>

#include <vtm/asset/asset.hpp>

namespace vtm::asset {

/// What a step of one picture unit changes a paint's channels by, premultiplied, at most, some 2/255 in all
/// neglected. Solid paints and programs with images, whose filters are for whole pixels: 0.
struct PaintChange {
    /// Where nothing bounds it: infinity; so hard stops, materials, gradients whose circles are next to not
    /// within each other, blend modes of what is not solid.
    float steepness = 0;
    /// The same with every ramp as if it changed evenly from its first stop to its last: hard stops count by
    /// what they change.
    float variation = 0;
    /// Of programs whose colour over a pixel is only about the mean, since layers are averaged one by one
    /// and radial ramps as if the pixel were small beside them. The larger of the variation of radial
    /// gradients, and of 2 √s, where s sums the products of two layers' steepness each: two of one steepness
    /// have twice that. Others: 0.
    float roughness = 0;
    bool mayJump = false;  ///< anywhere, since it has blend modes of what changes

    bool operator==(const PaintChange&) const = default;
};
/// By paint.
std::vector<PaintChange> changesOf(const AssetView& asset);

/// Some pixels of the picture: with middles in a disc, no two points further apart than `pixel`.
struct PixelsNear {
    glm::dvec2 middle;
    double radius, pixel;
};

/// What a paint changes by over one of such pixels, at most.
struct NearChange {
    float sum = 0;  ///< what layers change a premultiplied channel by, all added
    /// What the mean of layers over each other may be off by if their means are laid over each other instead:
    /// of two that change by c and d, no more than c d / 4.
    float joint = 0;
};
/// Hard stops count where they are. Solid paints and programs with images: 0; with materials: infinity.
NearChange changeNear(const AssetView& asset, std::uint32_t paint, const PixelsNear& pixels);

/// What an asset's paints change by, anywhere and near places. The asset must outlive it.
class PaintChanges {
public:
    explicit PaintChanges(const AssetView& asset);

    /// As changesOf().
    std::span<const PaintChange> byPaint() const { return byPaint_; }
    /// Within such pixels. No more than anywhere: of a gradient only those stretches count that lie there.
    PaintChange near(std::uint32_t paint, const PixelsNear& pixels) const;

private:
    struct GradientChange {
        Gradient gradient;
        double stretch;                     ///< of its matrix
        double slope, all;                  ///< of the ramp, anywhere (RampChange in steepness.cpp)
        double linearOffset, radialOffset;  ///< what u changes by over a unit of the picture, at most
    };
    const GradientChange& gradientAt(std::uint32_t texel);
    PaintChange of(const Paint& paint);

    std::span<const Paint> paints_;
    std::span<const Texel> data_;
    std::vector<PaintChange> byPaint_;
    std::vector<std::uint32_t> numbers_;  ///< in gradients_ and 1, by texel: many programs may use one
    std::vector<GradientChange> gradients_;
    std::vector<float> changes_;  ///< by texel of a stop: what the ramp changes by up to the next one
};

/// Two layers that each change by c over a pixel are off by c² / 12 at most, some 2/255 here.
inline constexpr double minRoughChange = 80.0 / 255;

/// A paint is steep that changes by more over a pixel. A part of a pixel is at most an eighth of a pixel's
/// side, times its area, away from the middle (half a pixel is), so what remains of others is below 2/255.
inline constexpr double minSteepChange = 16.0 / 255;

/// The steepness from which on a paint is steep. `pixel`: what a pixel's step in x and in y is in the
/// picture.
float minSteepness(const glm::dmat2& pixel);

}  // namespace vtm::asset
