/// \file
/// Boxes along the axes.
#pragma once

#include <limits>

#include <glm/common.hpp>
#include <glm/mat3x2.hpp>
#include <glm/vec2.hpp>

namespace vtm::geometry {

using Point = glm::dvec2;

/// All points p with min <= p <= max; empty where min > max in either coordinate, as it is at first.
struct Box {
    Point min{std::numeric_limits<double>::infinity()}, max{-std::numeric_limits<double>::infinity()};

    bool empty() const { return !(min.x <= max.x && min.y <= max.y); }
    double width() const { return max.x - min.x; }
    double height() const { return max.y - min.y; }
    void add(Point p) { min = glm::min(min, p), max = glm::max(max, p); }
    void add(const Box& other) { min = glm::min(min, other.min), max = glm::max(max, other.max); }
    /// The empty box is in every box.
    bool contains(const Box& other) const {
        return other.empty() ||
               (min.x <= other.min.x && min.y <= other.min.y && max.x >= other.max.x && max.y >= other.max.y);
    }
    Box intersection(const Box& other) const { return {glm::max(min, other.min), glm::min(max, other.max)}; }
};

/// The box of the mapped corners: the least one round the mapped box. Empty if `box` is.
Box mapped(const Box& box, const glm::dmat3x2& map);

}  // namespace vtm::geometry
