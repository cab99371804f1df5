/// \file
/// What tests of strokes look at: an outline's curves, winding numbers and area.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <vtm/compiler/stroke.hpp>

namespace vtm::compiler {

using namespace scene;
using std::numbers::pi;

inline double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }

using Curve = std::array<Point, 4>;

inline Point at(const Curve& c, double t) {
    const double s = 1 - t;
    return c[0] * (s * s * s) + c[1] * (3 * s * s * t) + c[2] * (3 * s * t * t) + c[3] * (t * t * t);
}

/// A path of lines, quads and cubics as cubics.
class Curves {
public:
    void operator()(const MoveTo& c) { start_ = at_ = c.to; }
    void operator()(const LineTo& c) { add(at_ + (c.to - at_) / 3.0, c.to + (at_ - c.to) / 3.0, c.to); }
    void operator()(const QuadTo& c) {
        add(at_ + (c.control - at_) * (2.0 / 3), c.to + (c.control - c.to) * (2.0 / 3), c.to);
    }
    void operator()(const CubicTo& c) { add(c.control1, c.control2, c.to); }
    void operator()(const ArcTo&) { FAIL() << "an arc where none may be"; }
    void operator()(const Close&) { (*this)(LineTo{start_}); }
    std::vector<Curve> list;

private:
    void add(Point a, Point b, Point to) {
        list.push_back({at_, a, b, to});
        at_ = to;
    }
    Point start_{0, 0}, at_{0, 0};
};

inline std::vector<Curve> curves(const Path& path) {
    Curves result;
    for (const Command& c : path)
        std::visit(result, c);
    return result.list;
}

/// Signed crossings with the ray from `p` towards +x.
inline int crossings(const Curve& c, Point p, int depth = 50) {
    const auto [low, high] = std::minmax({c[0].y, c[1].y, c[2].y, c[3].y});
    const auto [left, right] = std::minmax({c[0].x, c[1].x, c[2].x, c[3].x});
    if (high <= p.y || low > p.y || right <= p.x)
        return 0;
    if (left > p.x || depth == 0)
        return (c[3].y > p.y) - (c[0].y > p.y);
    const Point a = (c[0] + c[1]) / 2.0, b = (c[1] + c[2]) / 2.0, d = (c[2] + c[3]) / 2.0;
    const Point e = (a + b) / 2.0, f = (b + d) / 2.0, m = (e + f) / 2.0;
    return crossings({c[0], a, e, m}, p, depth - 1) + crossings({m, f, d, c[3]}, p, depth - 1);
}

inline int winding(const std::vector<Curve>& outline, Point p) {
    int result = 0;
    for (const Curve& c : outline)
        result += crossings(c, p);
    return result;
}

/// Green's theorem, exact for cubics; overlaps count twice.
inline double area(const Path& path) {
    double sum = 0;
    for (const Curve& c : curves(path))
        sum += 3.0 / 20 *
                   (cross(c[0], c[1]) * 2 + cross(c[0], c[2]) + cross(c[1], c[2]) + cross(c[1], c[3]) +
                    2 * cross(c[2], c[3])) +
               cross(c[0], c[3]) / 20;
    return sum;
}

inline std::size_t edges(const Path& path) {
    return std::size_t(std::count_if(path.begin(), path.end(),
                                     [](const Command& c) { return !std::holds_alternative<MoveTo>(c); }));
}

inline std::size_t contours(const Path& path) {
    return std::size_t(std::count_if(path.begin(), path.end(),
                                     [](const Command& c) { return std::holds_alternative<MoveTo>(c); }));
}

inline StrokeStyle style(double width, Cap cap = Cap::Butt, Join join = Join::Miter) {
    StrokeStyle s;
    s.width = width;
    s.cap = cap;
    s.join = join;
    return s;
}

inline bool inside(const Path& outline, Point p) { return winding(curves(outline), p) != 0; }

inline Path polyline(std::initializer_list<Point> points, bool closed = false) {
    Path path{MoveTo{*points.begin()}};
    for (const Point* p = points.begin() + 1; p != points.end(); ++p)
        path.push_back(LineTo{*p});
    if (closed)
        path.push_back(Close{});
    return path;
}

}  // namespace vtm::compiler
