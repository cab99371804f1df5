/// \file
/// Paths as lists of plain curves, and curves as chains of short chords.
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

/// A point on a curve and the curve's direction there (unit length, or zero where all is one point).
struct Sample {
    Point at;
    Vector direction;
};

/// How fine the chords are. Lengths are in pixels, whatever space the curve is in.
struct Fineness {
    Affine toPixels;
    Box view;          ///< pixels: what lies outside may be coarse
    double tolerance;  ///< greatest distance between chord and curve
    double maxTurn;    ///< greatest turn of the curve's direction along a chord, radians
    /// The tolerance outside the view, as a share of the piece's size.
    double hiddenTolerance;
};

/// A whole piece becomes its chord: right for windings, since the lens between lies outside the view.
inline constexpr double wholePiece = 1e9;

/// The samples from a curve's start to its end, both included, in the curve's own space.
std::vector<Sample> flatten(const Curve& curve, const Fineness& fineness);

}  // namespace vtm::reference
