/// \file
/// Small vector geometry in doubles.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include <vtm/scene/affine.hpp>
#include <vtm/scene/path.hpp>

namespace vtm::reference {

using scene::Affine;
using scene::Point;
using Vector = glm::dvec2;

inline double cross(Vector a, Vector b) { return a.x * b.y - a.y * b.x; }
inline double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y; }
inline double length(Vector v) { return std::hypot(v.x, v.y); }
/// A quarter turn from x towards y.
inline Vector normalOf(Vector direction) { return {-direction.y, direction.x}; }
/// The angle from a to b, in [0, pi].
inline double angleBetween(Vector a, Vector b) { return std::atan2(std::abs(cross(a, b)), dot(a, b)); }

struct Box {
    Point min, max;

    static Box around(std::span<const Point> points) {
        Box box{points[0], points[0]};
        for (const Point p : points.subspan(1)) {
            box.min = glm::dvec2(std::min(box.min.x, p.x), std::min(box.min.y, p.y));
            box.max = glm::dvec2(std::max(box.max.x, p.x), std::max(box.max.y, p.y));
        }
        return box;
    }
    double size() const { return std::max(max.x - min.x, max.y - min.y); }
    bool meets(const Box& other) const {
        return min.x <= other.max.x && other.min.x <= max.x && min.y <= other.max.y && other.min.y <= max.y;
    }
    Box grownBy(double margin) const { return {min - Vector(margin), max + Vector(margin)}; }
};

/// The largest factor by which the map lengthens a vector: its first singular value.
inline double largestScale(const Affine& m) {
    const double sum = dot(m[0], m[0]) + dot(m[1], m[1]);
    const double det = scene::determinant(m);
    return std::sqrt((sum + std::sqrt(std::max(0.0, sum * sum - 4 * det * det))) / 2);
}

}  // namespace vtm::reference
