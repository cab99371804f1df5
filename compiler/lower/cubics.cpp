#include "compiler/lower/cubics.hpp"
#include <vtm/limits/limits.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/center_form.hpp"

namespace vtm::compiler {
namespace {

using geometry::EllipticalArc;
using scene::Affine;
using scene::Point;

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
        sink_.cubic(geometry::raised(p0, q, p3));
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

    double partAngle(const EllipticalArc& mappedArc) const {
        const double radius = std::sqrt(glm::dot(mappedArc.axisX, mappedArc.axisX) +
                                        glm::dot(mappedArc.axisY, mappedArc.axisY));
        const double error = cubicArcError * radius;
        if (!(error > arcTolerance_))
            return cubicArcAngle;
        return std::max(finestArcAngle, cubicArcAngle * std::pow(arcTolerance_ / error, 1.0 / 6));
    }

    void arc(const scene::ArcTo& c) {
        if (current_ == c.to)
            return;
        const auto arc = scene::centerForm(current_, c);
        if (!arc)
            return sink_.line(map(c.to));
        const EllipticalArc mapped = geometry::mapped(*arc, m_);
        std::vector<Cubic> parts = geometry::cubics(mapped, geometry::cubicCount(mapped, partAngle(mapped)));
        parts.front().p0 = map(current_);
        parts.back().p3 = map(c.to);
        for (const Cubic& part : parts)
            sink_.cubic(part);
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
