#include "compiler/src/outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace vtm::compiler {
namespace {

using scene::Affine;
using scene::Point;
using Cubic = std::array<Point, 4>;

/// Coordinates beyond this many steps are pulled in to it, far outside any picture, so that
/// differences and products stay finite.
constexpr double farAway = 1e100;

Point lerp(Point a, Point b, double t) { return a + (b - a) * t; }

/// Takes points in steps, cuts the polyline at the box, emits chords between even vertices.
class ChordSink {
public:
    ChordSink(glm::dvec2 min, glm::dvec2 max) : min_(min), max_(max) {}

    void start(Point p) {
        current_ = p;
        vertex_ = quantise(p);
    }

    void line(Point to) {
        const std::array<double, 6> cuts = boxCuts(current_, to);
        for (double t : cuts)
            if (t > 0 && t < 1)
                emit(quantise(lerp(current_, to, t)));
        emit(quantise(to));
        current_ = to;
    }

    Point min() const { return min_; }
    Point max() const { return max_; }
    std::vector<Chord> take() { return std::move(chords_); }

private:
    /// Where the segment meets the four lines of the box, ascending: between two cuts clamping is an
    /// affine map and keeps the segment straight.
    std::array<double, 6> boxCuts(Point a, Point b) const {
        std::array<double, 6> cuts{};
        const Point d = b - a;
        for (int axis = 0; axis < 2; ++axis)
            if (d[axis] != 0) {
                cuts[static_cast<std::size_t>(2 * axis)] = (min_[axis] - a[axis]) / d[axis];
                cuts[static_cast<std::size_t>(2 * axis + 1)] = (max_[axis] - a[axis]) / d[axis];
            }
        std::sort(cuts.begin(), cuts.end());
        return cuts;
    }

    LatticePoint quantise(Point p) const {
        const auto even = [](double v) { return static_cast<Coord>(2 * std::floor(v / 2 + 0.5)); };
        return {even(std::clamp(p.x, min_.x, max_.x)), even(std::clamp(p.y, min_.y, max_.y))};
    }

    void emit(LatticePoint to) {
        if (to != vertex_)
            chords_.push_back({vertex_, to});
        vertex_ = to;
    }

    glm::dvec2 min_, max_;
    Point current_{};
    LatticePoint vertex_{};
    std::vector<Chord> chords_;
};

bool beyondOneSide(const Cubic& c, Point min, Point max) {
    for (int axis = 0; axis < 2; ++axis) {
        const auto [lo, hi] = std::minmax({c[0][axis], c[1][axis], c[2][axis], c[3][axis]});
        if (hi < min[axis] || lo > max[axis])
            return true;
    }
    return false;
}

Point evaluate(const Cubic& c, double t) {
    const double u = 1 - t;
    return c[0] * (u * u * u) + c[1] * (3 * u * u * t) + c[2] * (3 * u * t * t) + c[3] * (t * t * t);
}

std::array<Cubic, 2> halve(const Cubic& c) {
    const Point a = lerp(c[0], c[1], 0.5), b = lerp(c[1], c[2], 0.5), d = lerp(c[2], c[3], 0.5);
    const Point ab = lerp(a, b, 0.5), bd = lerp(b, d, 0.5), m = lerp(ab, bd, 0.5);
    return {Cubic{c[0], a, ab, m}, Cubic{m, bd, d, c[3]}};
}

/// Chords needed so that none is further than `tolerance` from the curve: the chord of a step h
/// deviates by at most h² max|P''| / 8, and |P''| <= 6 max|second difference of the controls|
/// (Wang, Shen 1988). Domain: any cubic; the count may be infinite.
double chordsNeeded(const Cubic& c, double tolerance) {
    const Point d0 = c[0] - c[1] * 2.0 + c[2], d1 = c[1] - c[2] * 2.0 + c[3];
    const double second = std::sqrt(std::max(d0.x * d0.x + d0.y * d0.y, d1.x * d1.x + d1.y * d1.y));
    return std::max(1.0, std::ceil(std::sqrt(0.75 * second / tolerance)));
}

/// Cubics that would need more chords than this are halved first, so that parts outside the box can
/// be left out and chords follow the curvature.
constexpr double chordsAtOnce = 8;
/// Halving so often brings any curve below a lattice step.
constexpr int maxHalvings = 400;

void flatten(ChordSink& sink, const Cubic& c, double tolerance, int halvings = 0) {
    const double n = chordsNeeded(c, tolerance);
    if (beyondOneSide(c, sink.min(), sink.max()) || n <= 1 || halvings >= maxHalvings) {
        sink.line(c[3]);
        return;
    }
    if (n <= chordsAtOnce) {
        for (int i = 1; i < static_cast<int>(n); ++i)
            sink.line(evaluate(c, i / n));
        sink.line(c[3]);
        return;
    }
    for (const Cubic& half : halve(c))
        flatten(sink, half, tolerance, halvings + 1);
}

/// An elliptical arc by its centre: p(θ) = centre + x cos θ + y sin θ, θ from `from` over `sweep`.
struct CenterArc {
    Point center, x, y;
    double from, sweep;
    Point at(double angle) const { return center + x * std::cos(angle) + y * std::sin(angle); }
    Point derivative(double angle) const { return y * std::cos(angle) - x * std::sin(angle); }
};

/// Endpoint to centre parametrisation, SVG 2 appendix B.2.4 and B.2.5. Radii must not be zero.
CenterArc centerArc(Point from, const scene::ArcTo& arc) {
    Point r{std::abs(arc.radii.x), std::abs(arc.radii.y)};
    const Point axis{std::cos(arc.rotation), std::sin(arc.rotation)};
    const Point half = (from - arc.to) * 0.5;
    const Point p{(half.x * axis.x + half.y * axis.y) / r.x, (half.y * axis.x - half.x * axis.y) / r.y};
    const double length2 = p.x * p.x + p.y * p.y;
    const double grow = std::max(1.0, std::sqrt(length2));
    r *= grow;
    const Point q = p / grow;  // half the chord on the unit circle
    const double q2 = std::min(1.0, q.x * q.x + q.y * q.y);
    const double side = (arc.largeArc == arc.sweep ? -1.0 : 1.0) * std::sqrt(std::max(0.0, 1 / q2 - 1));
    const Point c{side * q.y, -side * q.x};  // centre on the unit circle's plane
    const double begin = std::atan2(q.y - c.y, q.x - c.x);
    double sweep = std::atan2(-q.y - c.y, -q.x - c.x) - begin;
    if (arc.sweep && sweep < 0)
        sweep += 2 * std::numbers::pi;
    if (!arc.sweep && sweep > 0)
        sweep -= 2 * std::numbers::pi;
    const Point x = axis * r.x, y = Point{-axis.y, axis.x} * r.y;
    return {(from + arc.to) * 0.5 + x * c.x + y * c.y, x, y, begin, sweep};
}

/// Sixteenths of a turn as cubics: relative error of the radius 2/27 (sin⁶(θ/4) / cos²(θ/4)) at
/// θ = π/8, 6e-8, far below any tolerance.
constexpr double cubicArcAngle = std::numbers::pi / 8;

void flattenArc(ChordSink& sink, Point from, const scene::ArcTo& arc, const Affine& m, double tolerance) {
    const Point to = scene::apply(m, arc.to);
    const bool straight = arc.radii.x == 0 || arc.radii.y == 0;
    if (straight || from == arc.to) {
        if (straight)
            sink.line(to);
        return;
    }
    const CenterArc circle = centerArc(from, arc);
    const int parts = std::max(1, static_cast<int>(std::ceil(std::abs(circle.sweep) / cubicArcAngle)));
    const double step = circle.sweep / parts, arm = 4.0 / 3.0 * std::tan(step / 4);
    Point p0 = from;
    for (int i = 0; i < parts; ++i) {
        const double a0 = circle.from + step * i, a1 = a0 + step;
        const Point p3 = i + 1 == parts ? arc.to : circle.at(a1);
        const Cubic c{p0, p0 + circle.derivative(a0) * arm, p3 - circle.derivative(a1) * arm, p3};
        flatten(sink,
                {scene::apply(m, c[0]), scene::apply(m, c[1]), scene::apply(m, c[2]), scene::apply(m, c[3])},
                tolerance);
        p0 = p3;
    }
}

Affine tame(Affine m) {
    for (int c = 0; c < 3; ++c)
        m[c] = glm::dvec2{std::clamp(m[c].x, -farAway, farAway), std::clamp(m[c].y, -farAway, farAway)};
    return m;
}

/// Walks the commands with the current point in path space.
class Walker {
public:
    Walker(ChordSink& sink, const Affine& m, double tolerance) : sink_(sink), m_(m), tolerance_(tolerance) {}

    void operator()(const scene::MoveTo& c) {
        close();
        begin(c.to);
    }
    void operator()(const scene::LineTo& c) {
        sink_.line(map(c.to));
        current_ = c.to;
    }
    void operator()(const scene::QuadTo& c) {
        const Point p0 = map(current_), q = map(c.control), p3 = map(c.to);
        flatten(sink_, {p0, lerp(p0, q, 2.0 / 3), lerp(p3, q, 2.0 / 3), p3}, tolerance_);
        current_ = c.to;
    }
    void operator()(const scene::CubicTo& c) {
        flatten(sink_, {map(current_), map(c.control1), map(c.control2), map(c.to)}, tolerance_);
        current_ = c.to;
    }
    void operator()(const scene::ArcTo& c) {
        flattenArc(sink_, current_, c, m_, tolerance_);
        current_ = c.to;
    }
    void operator()(const scene::Close&) {
        close();
        begin(start_);
    }
    void close() {
        if (started_)
            sink_.line(map(start_));
    }

private:
    Point map(Point p) const { return scene::apply(m_, p); }
    void begin(Point p) {
        start_ = current_ = p;
        started_ = true;
        sink_.start(map(p));
    }

    ChordSink& sink_;
    const Affine m_;
    const double tolerance_;
    Point start_{}, current_{};
    bool started_ = false;
};

}  // namespace

std::vector<Chord> outline(const scene::Path& path, const Affine& toSteps, double tolerance,
                           glm::dvec2 clampMin, glm::dvec2 clampMax) {
    ChordSink sink(clampMin, clampMax);
    Walker walker(sink, tame(toSteps), tolerance);
    for (const scene::Command& command : path)
        std::visit(walker, command);
    walker.close();
    return sink.take();
}

double largestStretch(const Affine& m) {
    // Largest singular value of the linear part: sqrt of the larger eigenvalue of MᵀM.
    const double a = m[0].x * m[0].x + m[0].y * m[0].y, d = m[1].x * m[1].x + m[1].y * m[1].y;
    const double b = m[0].x * m[1].x + m[0].y * m[1].y;
    return std::sqrt((a + d) / 2 + std::hypot((a - d) / 2, b));
}

}  // namespace vtm::compiler
