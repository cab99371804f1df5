/// \file
/// A picture under a view that keeps only the pixels round what has been drawn on it.
#pragma once

#include <span>
#include <vector>

#include <vtm/image/bitmap.hpp>
#include <vtm/raster/view.hpp>
#include "raster/src/float4.hpp"
#include "raster/src/pixel_box.hpp"

namespace vtm::asset {

/// Premultiplied sRGB-encoded pixels of a box of the view's raster; all others are transparent.
class Canvas {
public:
    explicit Canvas(const View& of) : view_(of) {}
    /// `pixels`: of the box, row by row.
    Canvas(const View& of, const PixelBox& box, std::vector<Float4> pixels)
        : view_(of), box_(box), pixels_(std::move(pixels)) {}

    const View& view() const { return view_; }
    const PixelBox& box() const { return box_; }
    PixelBox whole() const { return {{0, 0}, {view_.width, view_.height}}; }

    /// Keeps the pixels of a box, which must lie in the raster, too.
    void include(const PixelBox& box);
    /// Forgets all pixels but those of a box.
    void restrictTo(const PixelBox& box);
    /// Pixels of a row of the raster, which is in the box, from box().min.x.
    Float4* row(int y) { return pixels_.data() + offset(y); }
    const Float4* row(int y) const { return pixels_.data() + offset(y); }
    std::span<const Float4> pixels() const { return pixels_; }

    /// The whole raster, each channel in [0, 1].
    image::Raster toRaster() const;

private:
    std::size_t offset(int y) const { return std::size_t(y - box_.min.y) * std::size_t(box_.width()); }

    View view_;
    PixelBox box_;
    std::vector<Float4> pixels_;
};

/// Calls change(pixel of `to`, of `from`) where `from` has pixels.
template <class Change>
void combine(const Canvas& from, Canvas& to, Change change) {
    to.include(from.box());
    for (int y = from.box().min.y; y < from.box().max.y; ++y) {
        const Float4* source = from.row(y);
        Float4* target = to.row(y) + (from.box().min.x - to.box().min.x);
        for (int x = 0; x < from.box().width(); ++x)
            target[x] = change(target[x], source[x]);
    }
}

}  // namespace vtm::asset
