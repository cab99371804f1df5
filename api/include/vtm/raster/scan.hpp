/// \file
/// Drawing exact pictures on the CPU, fast: every piece of boundary adds the change of colour that it means
/// for the pixels on its right, and running sums along the rows make pixels of the changes. The work is that
/// of the boundaries' pixels; all others are filled. Any affine view, no index, nothing prepared for a scale.
/// docs/coverage.md has the sum; the idea of summing along rows is old (accumulation buffers of glyph
/// rasterizers), colours instead of coverage are what disjoint regions allow.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec4.hpp>

#include <vtm/asset/asset.hpp>
#include <vtm/asset/difference.hpp>
#include <vtm/raster/evaluate.hpp>
#include <vtm/raster/pixel_box.hpp>
#include <vtm/raster/view.hpp>

#pragma GCC visibility push(default)

namespace vtm::asset {

struct PlanarMap;

/// Premultiplied bytes red, green, blue, alpha, in the scanner's numbers; rows from the top.
struct ByteTarget {
    std::uint8_t* pixels = nullptr;
    std::size_t rowBytes = 0;  ///< from one row to the next, at least 4 · view.width
};

/// Gives the floats of pixels first to end - 1 of row y, four each.
using PixelsToAddTo = std::function<float*(int y, int first, int end)>;

/// Pixels first to end - 1 of a row.
struct ColorRun {
    int first, end;
    glm::vec4 color;
};

/// The colour space in which coverage is accumulated, and of the result.
enum class Sums {
    Encoded,  ///< c·a, sRGB-encoded, as evaluate() draws
    Light     ///< lin(c)·a, of every region's colour: half a pixel's coverage gives half the light
};

/// Draws one asset. Copies the data that it needs, so the asset may go. Safe to use from several threads at
/// once, except for update().
class Scanner {
public:
    /// `asset` must be valid (asset::validate). Throws std::invalid_argument unless it is a sum of maps.
    explicit Scanner(const AssetView& asset, Sums sums = Sums::Encoded);
    /// Of planar maps (raster/planar_map.hpp) with the paints of `asset`, whose trees are not read.
    Scanner(std::span<const PlanarMap> maps, const AssetView& asset, Sums sums = Sums::Encoded);
    ~Scanner();
    Scanner(Scanner&&) noexcept;
    Scanner& operator=(Scanner&&) noexcept;

    /// Goes on to the next asset, `difference` being what changed from the last one that was given. The work
    /// is that of the squares that changed. If it throws, nothing may be drawn before an update succeeds with
    /// `difference.everything`.
    void update(const AssetView& asset, const Difference& difference);

    /// How far the asset may be magnified: Asset::finestPixel.
    std::optional<double> finestPixel() const;

    /// Replaces every pixel, rounded to nearest. Large pictures are drawn on all processors unless
    /// `materials` is given; the bytes do not depend on their number. Throws std::length_error if the view is
    /// beyond its limits.
    void draw(const View& view, const ByteTarget& target, const MaterialFunction& materials = {}) const;
    /// Replaces the pixels of a box of the view alone, at their places in the target; the work is that of the
    /// box. Rounding may make a difference of 1/255 to what draw() makes of them, of 3/255 where paints
    /// change much within a pixel.
    void drawBox(const View& view, const PixelBox& box, const ByteTarget& target,
                 const MaterialFunction& materials = {}) const;
    /// The same as the first in floats.
    image::Raster draw(const View& view, const MaterialFunction& materials = {}) const;

    /// Adds what it draws, each channel in [0, 1], to pixels; asks for those that are not transparent.
    void add(const View& view, const PixelsToAddTo& pixels, const MaterialFunction& materials = {}) const;

    /// What draw() draws, as runs of pixels of one colour, which is not clamped: row by row, from left to
    /// right, every pixel once.
    void scan(const View& view, const std::function<void(int y, const ColorRun& run)>& take,
              const MaterialFunction& materials = {}) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Boxes around the pixels that `difference` may change, few where that is cheaper to draw.
std::vector<PixelBox> changedPixels(const View& view, const Difference& difference);

}  // namespace vtm::asset

#pragma GCC visibility pop
