/// \file
/// Pixels of an image as colours: nearest, interpolated, tiled (specification sections 9.4 and 10.8).
#pragma once

#include "api/openvg/draw/pixel_source.hpp"

namespace vtm::openvg {

/// An image that goes on outside of its borders.
class Texels {
public:
    Texels(const Image& image, VGTilingMode tiling, const std::array<VGfloat, 4>& fillColor);

    const Image& image() const { return image_; }
    /// Of colours: the image's own, premultiplied.
    ColorSpace space() const;
    VGTilingMode tiling() const { return tiling_; }
    /// The fill colour of VG_TILE_FILL, in space().
    Color fill() const { return fill_; }

    /// A column or a row of the image for one of the plane, any whole number; -1 for the fill colour.
    int column(double x) const { return inside(x, image_.width()); }
    int row(double y) const { return inside(y, image_.height()); }
    /// At whole numbers, in space().
    Color at(double x, double y) const;

private:
    int inside(double v, int size) const;

    const Image& image_;
    VGTilingMode tiling_;
    Color fill_;
};

/// A side of a pixel's footprint that is longer than a texel is sampled at least once a texel, up to this
/// many times.
inline constexpr int maxSamples = 16;
int samplesAlong(glm::dvec2 side);

/// Nearest, bilinear if smooth, or where the view minifies the mean of bilinear samples over the pixel's
/// footprint. `fromSurface` leads to the image's coordinates.
std::unique_ptr<PixelSource> texelSource(const Texels& texels, const glm::dmat3& fromSurface, bool isSmooth);

}  // namespace vtm::openvg
