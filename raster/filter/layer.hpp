/// \file
/// The pictures that filters work on: boxes of pixels on the raster of a filter.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <vtm/raster/pixel_box.hpp>
#include "raster/src/float4.hpp"
#include "raster/src/pixel_memory.hpp"
#include "raster/src/row_parts.hpp"

namespace vtm::asset {

/// Premultiplied colours of the pixels of a box, transparent beyond it: in linear light or sRGB-encoded.
struct Layer {
    PixelBox box;
    bool linear = false;
    PixelMemory pixels;

    Layer() = default;
    Layer(const PixelBox& of, bool isLinear) : box(of), linear(isLinear), pixels(of.area(), Float4{}) {}
    Layer(const PixelBox& of, bool isLinear, PixelMemory&& memory)
        : box(of), linear(isLinear), pixels(std::move(memory)) {}
    /// To be written: its pixels have no value yet.
    static Layer unwritten(const PixelBox& of, bool isLinear) {
        PixelMemory memory;
        memory.resize(of.area());
        return {of, isLinear, std::move(memory)};
    }

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
/// The same between the centres of its pixels, (x, y) being counted from that of its first one.
inline Float4 bilinearInside(const Layer& layer, double x, double y) {
    const int left = int(x), top = int(y);
    const float u = float(x - left), v = float(y - top);
    const Float4* const above = layer.pixels.data() + std::ptrdiff_t(top) * layer.width() + left;
    const Float4* const below = above + layer.width();
    const Float4 upper = above[0] + u * (above[1] - above[0]), lower = below[0] + u * (below[1] - below[0]);
    return upper + v * (lower - upper);
}

/// What a layer has of the columns of a box, transparent beyond it, row by row.
class LayerRows {
public:
    /// `layer` must outlive it.
    LayerRows(const Layer& layer, const PixelBox& box)
        : layer_(layer), box_(box), both_(box.intersection(layer.box)) {
        const bool coversColumns = both_.width() == box.width();
        if (!coversColumns || both_.height() < box.height())
            blank_.resize(std::size_t(box.width()));
        if (!coversColumns)
            row_.resize(std::size_t(box.width()));
    }

    /// Valid until the next call.
    const Float4* operator()(int y) {
        if (both_.empty() || y < both_.min.y || y >= both_.max.y)
            return blank_.data();
        const Float4* from = layer_.row(y) + (both_.min.x - layer_.box.min.x);
        if (row_.empty())
            return from;
        std::copy_n(from, both_.width(), row_.data() + (both_.min.x - box_.min.x));
        return row_.data();
    }

private:
    const Layer& layer_;
    const PixelBox box_, both_;
    std::vector<Float4> blank_, row_;
};

/// change(colour) of each pixel of a box.
template <class Change>
Layer changed(const Layer& input, const PixelBox& box, bool linear, Change change) {
    Layer result = Layer::unwritten(box, linear);
    byRows(box, [&](const PixelBox& part) {
        LayerRows rows(input, part);
        for (int y = part.min.y; y < part.max.y; ++y) {
            const Float4* from = rows(y);
            std::transform(from, from + part.width(), result.row(y), change);
        }
    });
    return result;
}

/// The same pixels of another box.
Layer cropped(const Layer& layer, const PixelBox& box);
Layer cropped(Layer&& layer, const PixelBox& box);
/// In linear light or sRGB-encoded.
Layer converted(const Layer& layer, bool linear);
Layer converted(Layer&& layer, bool linear);
/// Its alpha, black.
Layer alphaOf(const Layer& layer);

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

}  // namespace vtm::asset
