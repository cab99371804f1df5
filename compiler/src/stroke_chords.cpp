#include "compiler/src/stroke_chords.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "compiler/src/stroke_roots.hpp"

namespace vtm::compiler::stroke {
namespace {

/// Halvings of a chord that was guessed too long.
constexpr int maxHalvings = 12;
/// Chords of one convex part; where more are guessed, halving makes them.
constexpr double mostChords = 4096;

class ChordOffset {
public:
    ChordOffset(const Cubic& curve, double distance, double tolerance, Side& side)
        : curve_(curve), powers_(curve), distance_(distance), tolerance_(tolerance), side_(side) {}

    void run(double t0, double t1) {
        Vertex at = vertex(t0);
        for (const double inflection : rootsInside(powers(curvature(curve_).cross)))
            if (inflection > t0 && inflection < t1)
                at = convex(at, inflection);
        convex(at, t1);
    }

private:
    struct Vertex {
        double t;
        Point at, along;  ///< unit
    };

    Vertex vertex(double t) const {
        const double x = (3 * powers_.cubed.x * t + 2 * powers_.squared.x) * t + powers_.linear.x,
                     y = (3 * powers_.cubed.y * t + 2 * powers_.squared.y) * t + powers_.linear.y;
        const double square = x * x + y * y;
        constexpr double least = 1e-280, most = 1e280;  // beyond, squares lose digits or overflow
        if (!(t > 0 && t < 1 && square > least && square < most)) {
            const Point along = tangentAt(curve_, t);
            return {t, pointAt(curve_, t) + perp(along) * distance_, along};
        }
        const double share = 1 / std::sqrt(square), alongX = x * share, alongY = y * share;
        return {t,
                {((powers_.cubed.x * t + powers_.squared.x) * t + powers_.linear.x) * t + powers_.start.x -
                     alongY * distance_,
                 ((powers_.cubed.y * t + powers_.squared.y) * t + powers_.linear.y) * t + powers_.start.y +
                     alongX * distance_},
                {alongX, alongY}};
    }

    /// Chords for an equal part of [t, t + dt], divided by dt: a chord strays by a quarter of its length
    /// times half its turn, both of which grow with dt.
    double density(double t) const {
        constexpr double sure = 0.95;  // of the tolerance: the tangent strays a little farther than the curve
        const Point velocity = powers_.velocity(t);
        const double square = glm::dot(velocity, velocity);
        const double turn = cross(velocity, powers_.acceleration(t)) / square;
        const double speed = std::abs(std::sqrt(square) - distance_ * turn);
        const double chords = std::sqrt(speed * std::abs(turn) / (8 * sure * tolerance_));
        return chords < mostChords ? chords : 0;
    }

    /// Chords from a vertex to where t is `to`, between which the curve has no inflection, of equal shares by
    /// density.
    Vertex convex(Vertex at, double to) {
        constexpr int steps = 8;
        const double from = at.t, step = (to - from) / steps;
        std::array<double, steps + 1> sums{};
        double before = density(from);
        for (int i = 1; i <= steps; ++i) {
            const double here = density(from + step * i);
            sums[std::size_t(i)] = sums[std::size_t(i - 1)] + step * (before + here) / 2;
            before = here;
        }
        const int count = std::max(1, static_cast<int>(std::ceil(std::min(sums[steps], mostChords))));
        std::size_t in = 0;
        const double share = sums[steps] / count;
        for (int k = 1; k <= count; ++k) {
            const double goal = share * k;
            while (in + 1 < steps && sums[in + 1] < goal)
                ++in;
            const double t =
                k == count ? to : from + step * (double(in) + (goal - sums[in]) / (sums[in + 1] - sums[in]));
            const Vertex next = vertex(t);
            chord(at, next, maxHalvings);
            at = next;
        }
        return at;
    }

    void chord(const Vertex& a, const Vertex& b, int halvings) {
        const Vertex middle = vertex((a.t + b.t) / 2);
        if (halvings > 0 && !isNear(a, middle, b)) {
            chord(a, middle, halvings - 1);
            chord(middle, b, halvings - 1);
        } else {
            side_.edges.push_back({true, {}, {}, b.at});
        }
    }

    /// Whether the tangent in m strays no farther than the tolerance from the chord over its ends; all
    /// lengths times the chord's.
    bool isNear(const Vertex& a, const Vertex& m, const Vertex& b) const {
        const double x = b.at.x - a.at.x, y = b.at.y - a.at.y, mx = m.at.x - a.at.x, my = m.at.y - a.at.y;
        const double square = x * x + y * y, along = mx * x + my * y;
        const double slope = std::abs((m.along.x * y - m.along.y * x) / (m.along.x * x + m.along.y * y));
        const double most = std::abs(mx * y - my * x) + slope * std::max(along, square - along);
        if (most <= tolerance_ * std::sqrt(square))
            return true;
        // So short that its direction is rounding.
        return 2 * (glm::distance(a.at, m.at) + glm::distance(m.at, b.at)) <= tolerance_;
    }

    const Cubic& curve_;
    const PowerForm powers_;
    const double distance_, tolerance_;
    Side& side_;
};

}  // namespace

void appendChords(const Cubic& curve, double t0, double t1, double distance, double tolerance, Side& side) {
    ChordOffset(curve, distance, tolerance, side).run(t0, t1);
}

}  // namespace vtm::compiler::stroke
