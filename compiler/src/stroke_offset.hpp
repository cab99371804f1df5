/// \file
/// The two sides of a curve's ribbon.
#pragma once

#include <vector>

#include "compiler/src/stroke_curve.hpp"

namespace vtm::compiler::stroke {

struct Edge {
    bool straight;
    Point c1, c2, to;  ///< c1 and c2 only if curved
};

/// A run of edges.
struct Side {
    Point start{0, 0};
    std::vector<Edge> edges;

    Point end() const { return edges.empty() ? start : edges.back().to; }
    /// Adds nothing if the side is within `gap` of the point already.
    void lineTo(Point to, double gap = 0);
    void cubicTo(Point c1, Point c2, Point to) { edges.push_back({false, c1, c2, to}); }
};

Side reversed(const Side& side);

/// Left lies at +radius along perp(tangent), right at -radius.
struct Ribbon {
    Side left, right;
    std::vector<Side> beyond;  ///< closed contours, wound like left reversed after right
};

/// Steps below this share of the tolerance are left out: they would only cost edges.
inline constexpr double gapShare = 0.1;

struct OffsetOptions {
    double radius;
    double tolerance;
    bool beyond;    ///< wanted only if caps or joins are not round
    double chords;  ///< if above 0, gentle offsets become chords within this and the tolerance together

    /// How far a straight edge may stray.
    double straight() const { return tolerance + chords; }
};

/// Goes on with both sides along a curve without cusps. Both sides must have come to the offsets of
/// the curve's start already, within the tolerance.
void appendOffsets(const Cubic& curve, const OffsetOptions& options, Ribbon& ribbon);

}  // namespace vtm::compiler::stroke
