#include "compiler/lower/cubics.hpp"
#include <vtm/limits/limits.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vtm::compiler {
namespace {

using scene::Affine;
using scene::Point;

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

/// 32nds of a turn as cubics, or less: relative error of the radius 2/27 (sin⁶(θ/4) / cos²(θ/4)), which is
/// 1.1e-9 at θ = π/16 and falls with the sixth power of θ at least.
constexpr double cubicArcAngle = std::numbers::pi / 16, cubicArcError = 1.1e-9;
/// Arcs so much finer are near the limit of double precision.
constexpr double finestArcAngle = cubicArcAngle / 64;

/// Walks the commands with the current point in path space.
class Walker {
public:
    Walker(CurveSink& sink, const Affine& m, double arcTolerance)
        : sink_(sink), m_(m), arcTolerance_(arcTolerance) {}

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
        sink_.cubic({p0, p0 + (q - p0) * (2.0 / 3), p3 + (q - p3) * (2.0 / 3), p3});
        current_ = c.to;
    }
    void operator()(const scene::CubicTo& c) {
        sink_.cubic({map(current_), map(c.control1), map(c.control2), map(c.to)});
        current_ = c.to;
    }
    void operator()(const scene::ArcTo& c) {
        arc(c);
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
    Point map(Point p) const { return m_[0] * p.x + m_[1] * p.y + m_[2]; }

    void begin(Point p) {
        start_ = current_ = p;
        started_ = true;
        sink_.start(map(p));
    }

    double partAngle(const CenterArc& circle) const {
        const double radius = std::sqrt(squared(linear(circle.x)) + squared(linear(circle.y)));
        const double error = cubicArcError * radius;
        if (!(error > arcTolerance_))
            return cubicArcAngle;
        return std::max(finestArcAngle, cubicArcAngle * std::pow(arcTolerance_ / error, 1.0 / 6));
    }
    Point linear(Point v) const { return m_[0] * v.x + m_[1] * v.y; }
    static double squared(Point v) { return v.x * v.x + v.y * v.y; }

    void arc(const scene::ArcTo& c) {
        if (c.radii.x == 0 || c.radii.y == 0)
            return sink_.line(map(c.to));
        if (current_ == c.to)
            return;
        const CenterArc circle = centerArc(current_, c);
        const int parts =
            std::max(1, static_cast<int>(std::ceil(std::abs(circle.sweep) / partAngle(circle))));
        const double step = circle.sweep / parts, arm = 4.0 / 3.0 * std::tan(step / 4);
        Point p0 = current_;
        for (int i = 0; i < parts; ++i) {
            const double a0 = circle.from + step * i, a1 = a0 + step;
            const Point p3 = i + 1 == parts ? c.to : circle.at(a1);
            sink_.cubic({map(p0), map(p0 + circle.derivative(a0) * arm),
                         map(p3 - circle.derivative(a1) * arm), map(p3)});
            p0 = p3;
        }
    }

    CurveSink& sink_;
    const Affine m_;
    const double arcTolerance_;
    Point start_{}, current_{};
    bool started_ = false;
};

}  // namespace

scene::Affine withoutFarAway(scene::Affine m) {
    for (int c = 0; c < 3; ++c)
        m[c] = glm::dvec2{std::clamp(m[c].x, -farAway, farAway), std::clamp(m[c].y, -farAway, farAway)};
    return m;
}

void walkCurves(const scene::Path& path, const Affine& map, CurveSink& sink, double arcTolerance) {
    Walker walker(sink, withoutFarAway(map), arcTolerance);
    for (const scene::Command& command : path) {
        limits::check();
        std::visit(walker, command);
    }
    walker.close();
}

}  // namespace vtm::compiler
