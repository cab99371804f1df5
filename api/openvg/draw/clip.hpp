/// \file
/// Where drawing may change a surface (specification section 7.1).
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "api/openvg/state/context.hpp"

namespace vtm::openvg {

/// The part of a surface that drawing may change: its bounds, cut by the scissoring rectangles (section 7.1).
class Clip {
public:
    explicit Clip(const Context& context);

    /// A box around it.
    const Rectangle& bounds() const { return bounds_; }
    /// There is nothing more to it.
    bool isBox() const { return isBox_; }
    /// Calls part(first, end) for the columns from `first` to `end` of a row that are in it, each once.
    template <class Part>
    void parts(int y, int first, int end, Part&& part) const;

private:
    const std::vector<std::pair<int, int>>& columns(int y) const;

    Rectangle bounds_;
    bool isBox_ = true;
    std::vector<Rectangle> rectangles_;
    mutable int row_ = -1;
    mutable std::vector<std::pair<int, int>> columns_;  ///< of row_, disjoint
};

template <class Part>
void Clip::parts(int y, int first, int end, Part&& part) const {
    if (y < bounds_.y0 || y >= bounds_.y1)
        return;
    first = std::max(first, bounds_.x0);
    end = std::min(end, bounds_.x1);
    if (first >= end)
        return;
    if (isBox_)
        return part(first, end);
    for (const auto& [a, b] : columns(y))
        if (std::max(first, a) < std::min(end, b))
            part(std::max(first, a), std::min(end, b));
}

}  // namespace vtm::openvg
