#include "raster/src/canvas.hpp"

#include <algorithm>
#include <cstring>

namespace vtm::asset {

void Canvas::include(const PixelBox& box) {
    const PixelBox both = box_.joined(box);
    if (both.empty() || (both.min == box_.min && both.max == box_.max && !box_.empty()))
        return;
    std::vector<Float4> pixels(both.area());
    for (int y = box_.min.y; y < box_.max.y && !box_.empty(); ++y)
        std::copy_n(
            row(y), box_.width(),
            pixels.begin() + std::ptrdiff_t(y - both.min.y) * both.width() + (box_.min.x - both.min.x));
    box_ = both;
    pixels_ = std::move(pixels);
}

void Canvas::restrictTo(const PixelBox& box) {
    const PixelBox both = box_.intersection(box);
    if (both.empty()) {
        box_ = {};
        pixels_.clear();
        return;
    }
    if (both.min == box_.min && both.max == box_.max)
        return;
    Canvas smaller(view_);
    smaller.include(both);
    for (int y = both.min.y; y < both.max.y; ++y)
        std::copy_n(row(y) + (both.min.x - box_.min.x), both.width(), smaller.row(y));
    *this = std::move(smaller);
}

image::Raster Canvas::toRaster() const {
    image::Raster raster(view_.width, view_.height);
    for (int y = box_.min.y; y < box_.max.y && !box_.empty(); ++y) {
        const Float4* from = row(y);
        float* to = raster.pixel(box_.min.x, y);
        for (int x = 0; x < box_.width(); ++x)
            for (int c = 0; c < 4; ++c)
                *to++ = unit(from[x][c]);
    }
    return raster;
}

}  // namespace vtm::asset
