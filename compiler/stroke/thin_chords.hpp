/// \file
/// Thin strokes: as wide as what chords misplace, about. The offsets of a curve's chords stand for its own.
#pragma once

#include <span>
#include <vector>

#include "compiler/lower/chords.hpp"
#include "compiler/stroke/curve.hpp"

namespace vtm::compiler::stroke {

class ThinChords {
public:
    /// A stroke is thin if its radius is so many times the root of the area that chords misplace, at most: a
    /// third of a pixel. Without an area none is.
    static constexpr double mostThin = 8;

    ThinChords(double radius, const ChordTolerance& tolerance);

    bool isThin() const { return isThin_; }
    /// Radians that a curve turns by in a chord, at most, but in tight bends.
    double turn() const { return turn_; }

    /// Points of the curve, its ends included. What is shorter than half the area's root becomes one point:
    /// tight bends become corners. Valid until the next call.
    std::span<const Point> of(const Cubic& curve);

private:
    void cut(const Cubic& curve, int halvings);
    void add(Point to);
    bool isShort(Point to) const;

    double distance_, shortest_;
    bool isThin_;
    double turn_;
    ChordCutter cutter_;
    std::vector<Point> points_;
};

}  // namespace vtm::compiler::stroke
