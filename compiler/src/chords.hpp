/// \file
/// Cubics to chords, as few as the tolerance allows.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "compiler/src/cubics.hpp"

namespace vtm::compiler {

/// Cuts cubics where all their chords stray about equally far. A curve and its reverse are cut at the same
/// places. Keeps its memory from curve to curve.
///
/// Over a small step h of the parameter the curve P strays from its chord by h² |P' × P''| / (8 |P'|). So
/// sqrt(|P' × P''| / (8 |P'| tolerance)) chords are needed per unit of t, and steps with equal shares of its
/// integral make the fewest. What is guessed so is then proven, or halved.
class ChordCutter {
public:
    explicit ChordCutter(double tolerance) : tolerance_(tolerance), proof_(243 * tolerance * tolerance) {}

    /// The ends of chords within the tolerance, the last one that of the cubic. Empty if they would be more
    /// than `most`, or the cubic is infinite. Valid until the next call.
    std::span<const scene::Point> cut(const Cubic& cubic, double most);

private:
    using Point = scene::Point;
    static constexpr std::size_t steps = 16;  ///< of the integral
    struct Vertex {
        double t, x, y;
    };

    double integrate();
    Vertex vertex(double t) const;
    bool isProven(const Vertex& from, const Vertex& to) const;
    void chord(const Vertex& from, const Vertex& to, int halvings);

    const double tolerance_, proof_;
    Point a_, b_, c_, start_;  ///< P = ((a t + b) t + c) t + start
    std::array<double, steps + 1> density_, sums_;
    std::vector<Point> ends_;
};

}  // namespace vtm::compiler
