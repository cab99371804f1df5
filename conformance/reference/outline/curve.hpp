/// \file
/// Paths as lists of plain curves.
#pragma once

#include <array>
#include <variant>
#include <vector>

#include <vtm/scene/path.hpp>
#include "conformance/reference/outline/geometry.hpp"

namespace vtm::reference {

struct Line {
    Point from, to;
};

struct Cubic {
    std::array<Point, 4> p;
};

/// The points center + cos(a)·axisX + sin(a)·axisY for a from `begin` to `end` (radians, either
/// order, at most a full turn apart).
struct Arc {
    Point center;
    Vector axisX, axisY;
    double begin, end;
    Point from, to;  ///< the end points as the path names them, free of rounding
};

using Curve = std::variant<Line, Cubic, Arc>;

Point startOf(const Curve& curve);
Point endOf(const Curve& curve);

struct Subpath {
    Point start;
    std::vector<Curve> curves;  ///< each begins where the one before it ends
    bool closed = false;        ///< the closing line, where it has a length, is among the curves
};

/// Quadratics become cubics; endpoint arcs become centre arcs (SVG 2 appendix B.2.4, F.6 of SVG 1.1).
std::vector<Subpath> subpaths(const scene::Path& path);

}  // namespace vtm::reference
