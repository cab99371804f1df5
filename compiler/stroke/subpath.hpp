/// \file
/// Subpaths prepared for stroking, and their dashes.
#pragma once

#include <vector>

#include <vtm/scene/path.hpp>
#include <vtm/scene/stroke.hpp>
#include "compiler/stroke/curve.hpp"

namespace vtm::compiler::stroke {

/// Never a point, never with a cusp inside.
struct Segment {
    Cubic curve;
    bool straight;
    std::optional<Circle> circle;  ///< that the curve follows, turning by a quarter at most
    bool afterCusp;                ///< the curve turned back within itself where this segment starts
};

/// Connected segments. Without any, a dot `at` a point, whose caps look along `direction`.
struct Subpath {
    std::vector<Segment> segments;
    bool closed = false;
    Point at{0, 0};
    Point direction{1, 0};
};

/// Of the points, in magnitude.
double largestCoordinate(const scene::Path& path);

/// Arcs become cubics within `tolerance`; a lone MoveTo gives nothing (SVG 2 section 13.5.5).
std::vector<Subpath> subpaths(const scene::Path& path, double tolerance);

double largestCoordinate(const Subpath& subpath);

/// Where dashes end: to 1e-9 of the path's length, or as well as doubles can tell.
enum class DashPrecision { Usual, Finest };

/// The drawn parts of a subpath. Adds their number to `count` and throws LimitError beyond maxDashes.
std::vector<Subpath> dash(const Subpath& subpath, const scene::StrokeStyle& style, std::size_t& count,
                          DashPrecision precision = DashPrecision::Usual);

}  // namespace vtm::compiler::stroke
