#include "raster/src/canvas.hpp"

#include <algorithm>
#include <cstring>
#include <vector>

#include "raster/src/scan_stores.hpp"

namespace vtm::asset {

PixelBox Canvas::bounds() const {
    PixelBox all;
    for (int y = box_.min.y; y < box_.max.y; ++y)
        if (const PixelRun drawn = run(y); !drawn.empty())
            all = all.joined({{drawn.first, y}, {drawn.end, y + 1}});
    return all;
}

namespace {

/// With half as much again on the sides where `box` grows to `larger`, so that many small steps copy little.
PixelBox withRoom(const PixelBox& box, PixelBox larger, const PixelBox& whole) {
    if (box.empty())
        return larger;
    const glm::ivec2 room = (larger.max - larger.min) / 2;
    for (int axis = 0; axis < 2; ++axis) {
        if (larger.min[axis] < box.min[axis])
            larger.min[axis] -= room[axis];
        if (larger.max[axis] > box.max[axis])
            larger.max[axis] += room[axis];
    }
    return larger.intersection(whole);
}

}  // namespace

void Canvas::reserve(const PixelBox& box) {
    PixelBox both = box_.joined(box);
    if (both.empty() || (both.min == box_.min && both.max == box_.max))
        return;
    both = withRoom(box_, both, whole());
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

std::pair<PixelBox, PixelMemory> Canvas::takeBox() {
    for (int y = box_.min.y; y < box_.max.y; ++y) {
        PixelRun drawn = run(y);
        if (drawn.empty())
            drawn = {box_.max.x, box_.max.x};
        std::fill(at(y, box_.min.x), at(y, drawn.first), Float4{});
        std::fill(at(y, drawn.end), at(y, box_.max.x), Float4{});
    }
    runs_.clear();
    return {std::exchange(box_, {}), std::move(pixels_)};
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

void Canvas::toBytes(const ByteTarget& target) const {
    const ByteStore store(target, view_.width);
    eachRow(whole(), [&](int y) {
        const PixelRun drawn = run(y);
        if (drawn.empty()) {
            store(y, 0, view_.width, Float4{});
            return;
        }
        store(y, 0, drawn.first, Float4{});
        store(y, drawn.first, {at(y, drawn.first), at(y, drawn.end)});
        store(y, drawn.end, view_.width, Float4{});
    });
}

void Canvas::giveRows(int first, int end, const std::function<void(std::span<const float>)>& take) const {
    std::vector<Float4> pixels(std::size_t(view_.width));
    for (int y = first; y < end; ++y) {
        const PixelRun drawn = run(y);
        std::ranges::fill(pixels, Float4{});
        if (!drawn.empty())
            std::transform(at(y, drawn.first), at(y, drawn.end), pixels.begin() + drawn.first,
                           [](Float4 color) { return unit(color); });
        take({reinterpret_cast<const float*>(pixels.data()), 4 * pixels.size()});
    }
}

}  // namespace vtm::asset
