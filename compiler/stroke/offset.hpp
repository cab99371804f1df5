/// \file
/// The two sides of a curve's ribbon.
#pragma once

#include <vector>

#include "compiler/lower/area_chords.hpp"
#include "compiler/stroke/curve.hpp"

namespace vtm::compiler::stroke {

/// A run of edges, straight but for some.
struct Side {
    struct Curve {
        std::size_t edge;
        Point c1, c2;
    };
    Point start{0, 0};
    std::vector<Point> ends;    ///< of the edges
    std::vector<Curve> curves;  ///< edges that are cubics, rising

    Point end() const { return ends.empty() ? start : ends.back(); }
    bool endsStraight() const {
        return !ends.empty() && (curves.empty() || curves.back().edge + 1 < ends.size());
    }
    void clear() { ends.clear(), curves.clear(); }
    /// Adds nothing if the side is within `gap` of the point already.
    void lineTo(Point to, double gap = 0);
    void addLine(Point to) { ends.push_back(to); }
    /// To `count` points, given by coordinates.
    void addLines(const double* x, const double* y, int count);
    void cubicTo(Point c1, Point c2, Point to);
    /// Goes on with the edges of a side that starts where this one ends.
    void append(const Side& next);
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
    bool beyond;            ///< wanted only if caps or joins are not round
    ChordTolerance chords;  ///< if above 0, gentle offsets become chords within this and the tolerance

    /// How far a straight edge may stray.
    double straight() const { return tolerance + chords.distance; }
};

/// Goes on with both sides along a curve without cusps. Both sides must have come to the offsets of
/// the curve's start already, within the tolerance.
void appendOffsets(const Cubic& curve, const OffsetOptions& options, Ribbon& ribbon);

}  // namespace vtm::compiler::stroke
