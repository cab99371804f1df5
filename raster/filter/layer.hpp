/// \file
/// The pictures that filters work on: boxes of pixels on the raster of a filter.
#pragma once

#include <cstddef>

#include "raster/pixel_box.hpp"
#include "raster/src/float4.hpp"
#include "raster/src/pixel_memory.hpp"

namespace vtm::asset {

/// Premultiplied colours of the pixels of a box, transparent beyond it: in linear light or sRGB-encoded.
struct Layer {
    PixelBox box;
    bool linear = false;
    PixelMemory pixels;

    Layer() = default;
    Layer(const PixelBox& of, bool isLinear) : box(of), linear(isLinear), pixels(of.area(), Float4{}) {}

    int width() const { return box.width(); }
    int height() const { return box.height(); }
    bool empty() const { return pixels.empty(); }
    /// A row, its first pixel at box.min.x; y counts on the filter's raster.
    Float4* row(int y) { return pixels.data() + std::size_t(y - box.min.y) * std::size_t(width()); }
    const Float4* row(int y) const {
        return pixels.data() + std::size_t(y - box.min.y) * std::size_t(width());
    }
    Float4 at(int x, int y) const { return box.contains(x, y) ? row(y)[x - box.min.x] : Float4{}; }
};

/// Interpolated between the centres of four pixels; (x, y) is a point of the raster.
Float4 bilinear(const Layer& layer, float x, float y);

/// The same pixels of another box.
Layer cropped(Layer layer, const PixelBox& box);
/// In linear light or sRGB-encoded.
Layer converted(Layer layer, bool linear);
/// Its alpha, black.
Layer alphaOf(Layer layer);

/// What is more transparent has no colour of its own: it would be that of rounding, and operations on
/// straight colours may make it opaque. A quarter of what 8 bits can tell from nothing.
inline constexpr float leastAlpha = 1.0f / 1024;

/// Straight colour; zero where there is none.
inline Float4 straightened(Float4 c) {
    if (!(c[3] >= leastAlpha))
        return Float4{};
    const float scale = 1 / c[3];
    return c * Float4{scale, scale, scale, 1};
}

/// Calls change(colour) for each pixel and stores what it returns.
template <class Change>
void changePixels(Layer& layer, Change change) {
    for (Float4& pixel : layer.pixels)
        pixel = change(pixel);
}

}  // namespace vtm::asset
