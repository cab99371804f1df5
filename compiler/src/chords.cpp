#include "compiler/src/chords.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vtm::compiler {
namespace {

/// Brings any chord of a curve that may be cut below its tolerance.
constexpr int maxHalvings = 40;

double cross(scene::Point a, scene::Point b) { return a.x * b.y - a.y * b.x; }

}  // namespace

std::span<const scene::Point> ChordCutter::cut(const Cubic& p, double most) {
    a_ = p[3] - p[0] + 3.0 * (p[1] - p[2]);
    b_ = 3.0 * (p[0] - 2.0 * p[1] + p[2]);
    c_ = 3.0 * (p[1] - p[0]);
    start_ = p[0];
    ends_.clear();
    const double needed = integrate();
    if (!(needed <= most))
        return {};
    const int whole = static_cast<int>(needed), count = std::max(1, whole + (whole < needed));
    const double share = needed / count;
    std::size_t in = 0;
    Vertex at{0, start_.x, start_.y};
    for (int k = 1; k < count; ++k) {
        // The density is taken to be linear in each step.
        const double goal = share * k;
        while (in + 1 < steps && sums_[in + 1] < goal)
            ++in;
        const double d0 = density_[in], d1 = density_[in + 1], area = (goal - sums_[in]) * steps;
        const double root = std::sqrt(std::max(0.0, d0 * d0 + 2 * (d1 - d0) * area));
        const Vertex next = vertex((double(in) + std::min(1.0, 2 * area / (d0 + root))) / steps);
        chord(at, next, maxHalvings);
        at = next;
    }
    chord(at, {1, p[3].x, p[3].y}, maxHalvings);
    return ends_;
}

/// The number of chords that is guessed to do.
double ChordCutter::integrate() {
    constexpr double sure = 0.9;  // of the tolerance: steps are not small
    constexpr double leastSpeed = std::numeric_limits<double>::min();  // no division by zero
    const double c0 = 2 * cross(c_, b_), c1 = 6 * cross(c_, a_), c2 = -6 * cross(a_, b_);  // P' × P''
    const double per = 1 / (8 * sure * tolerance_);
    for (std::size_t i = 0; i <= steps; ++i) {
        const double t = double(i) / steps;
        const double vx = (3 * t * a_.x + 2 * b_.x) * t + c_.x, vy = (3 * t * a_.y + 2 * b_.y) * t + c_.y;
        const double speed = std::sqrt(vx * vx + vy * vy) + leastSpeed;
        density_[i] = std::sqrt(per * std::abs((c2 * t + c1) * t + c0) / speed);
    }
    sums_[0] = 0;
    for (std::size_t i = 0; i < steps; ++i)
        sums_[i + 1] = sums_[i] + (density_[i] + density_[i + 1]) * (0.5 / steps);
    return sums_[steps];
}

ChordCutter::Vertex ChordCutter::vertex(double t) const {
    return {t, ((a_.x * t + b_.x) * t + c_.x) * t + start_.x, ((a_.y * t + b_.y) * t + c_.y) * t + start_.y};
}

void ChordCutter::chord(const Vertex& from, const Vertex& to, int halvings) {
    if (halvings > 0 && !isProven(from, to)) {
        const Vertex middle = vertex((from.t + to.t) / 2);
        chord(from, middle, halvings - 1);
        chord(middle, to, halvings - 1);
    } else {
        ends_.push_back({to.x, to.y});
    }
}

/// Whether the curve lies within the tolerance of its chord d over a step h, from velocity v and acceleration
/// p to w and q. Along d it runs from one end to the other without turning back if the Bernstein coefficients
/// of d · P', which are d · v, d · (v + h p / 2) and d · w, are not negative. Across d it strays by f(s) = h²
/// s (1 - s) (d × p (2 - s) + d × q (1 + s)) / (6 |d|), so by h² (|d × p| + |d × q|) / (9 √3 |d|) at most.
bool ChordCutter::isProven(const Vertex& from, const Vertex& to) const {
    const double h = to.t - from.t, dx = to.x - from.x, dy = to.y - from.y;
    // d · P' = (da t + db) t + dc.
    const double da = 3 * (dx * a_.x + dy * a_.y), db = 2 * (dx * b_.x + dy * b_.y),
                 dc = dx * c_.x + dy * c_.y;
    const double slope = da * from.t + db, v = slope * from.t + dc, w = (da * to.t + db) * to.t + dc,
                 between = v + h * (da * from.t + 0.5 * db);
    const double ca = 6 * (dx * a_.y - dy * a_.x), cb = 2 * (dx * b_.y - dy * b_.x);  // d × P'' = ca t + cb
    const double across = h * h * (std::abs(ca * from.t + cb) + std::abs(ca * to.t + cb));
    return (v >= 0) & (w >= 0) & (between >= 0) & (across * across <= proof_ * (dx * dx + dy * dy));
}

}  // namespace vtm::compiler
