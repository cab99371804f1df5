#include "raster/src/canvas.hpp"

#include <algorithm>
#include <cstring>

namespace vtm::asset {

PixelBox Canvas::bounds() const {
    PixelBox all;
    for (int y = box_.min.y; y < box_.max.y; ++y)
        if (const PixelRun drawn = run(y); !drawn.empty())
            all = all.joined({{drawn.first, y}, {drawn.end, y + 1}});
    return all;
}

void Canvas::reserve(const PixelBox& box) {
    const PixelBox both = box_.joined(box);
    if (both.empty() || (both.min == box_.min && both.max == box_.max))
        return;
    Canvas larger(view_);
    larger.box_ = both;
    larger.runs_.resize(std::size_t(both.height()));
    larger.pixels_.resize(both.area());
    for (int y = box_.min.y; y < box_.max.y; ++y)
        if (const PixelRun drawn = run(y); !drawn.empty()) {
            larger.runs_[std::size_t(y - both.min.y)] = drawn;
            std::copy(at(y, drawn.first), at(y, drawn.end), larger.at(y, drawn.first));
        }
    *this = std::move(larger);
}

image::Raster Canvas::toRaster() const {
    image::Raster raster(view_.width, view_.height);
    for (int y = box_.min.y; y < box_.max.y; ++y) {
        const PixelRun drawn = run(y);
        if (drawn.empty())
            continue;
        float* to = raster.pixel(drawn.first, y);
        for (const Float4* from = at(y, drawn.first); from != at(y, drawn.end); ++from, to += 4) {
            const Float4 color = unit(*from);
            std::memcpy(to, &color, sizeof color);
        }
    }
    return raster;
}

}  // namespace vtm::asset
