#include "api/openvg/draw/clip.hpp"

#include <algorithm>

namespace vtm::openvg {

Clip::Clip(const Context& context) : bounds_(context.surface->bounds()) {
    if (!context.state.scissoring)
        return;
    Rectangle around{bounds_.x1, bounds_.y1, bounds_.x0, bounds_.y0};
    const std::vector<VGint>& r = context.state.scissorRects;
    for (std::size_t i = 0; i + 4 <= r.size(); i += 4) {
        if (r[i + 2] <= 0 || r[i + 3] <= 0)
            continue;
        const auto end = [](VGint start, VGint size) {
            return int(std::min(std::int64_t(start) + size, std::int64_t(maxSurfaceSide)));
        };
        const Rectangle box =
            Rectangle{r[i], r[i + 1], end(r[i], r[i + 2]), end(r[i + 1], r[i + 3])}.intersected(bounds_);
        if (box.empty())
            continue;
        rectangles_.push_back(box);
        around = {std::min(around.x0, box.x0), std::min(around.y0, box.y0), std::max(around.x1, box.x1),
                  std::max(around.y1, box.y1)};
    }
    isBox_ = rectangles_.size() <= 1;
    bounds_ = around;
}

const std::vector<std::pair<int, int>>& Clip::columns(int y) const {
    if (row_ == y)
        return columns_;
    row_ = y;
    columns_.clear();
    for (const Rectangle& r : rectangles_)
        if (r.y0 <= y && y < r.y1)
            columns_.emplace_back(r.x0, r.x1);
    std::ranges::sort(columns_);
    std::size_t kept = 0;
    for (const auto& part : columns_) {
        if (kept > 0 && part.first <= columns_[kept - 1].second)
            columns_[kept - 1].second = std::max(columns_[kept - 1].second, part.second);
        else
            columns_[kept++] = part;
    }
    columns_.resize(kept);
    return columns_;
}

}  // namespace vtm::openvg
