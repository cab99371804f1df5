#include "compiler/stroke/curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "geometry/length.hpp"
#include "scene/center_form.hpp"

namespace vtm::compiler::stroke {

namespace {

/// Speeds below this share of the curve's extent carry no direction any more: rounding errors of
/// about 1e-16 leave seven digits of a tangent at this length.
constexpr double vanishingSpeed = 1e-9;

double squaredDistance(Point a, Point b) { return glm::dot(b - a, b - a); }
double squaredExtent(const Cubic& c) {
    return std::max({squaredDistance(c.p0, c.p1), squaredDistance(c.p0, c.p2), squaredDistance(c.p0, c.p3)});
}

auto speedOf(const Cubic& c) {
    return [&c](double t) { return glm::length(c.derivative(t)); };
}

}  // namespace

Point rotate(Point v, double angle) { return v * std::cos(angle) + perp(v) * std::sin(angle); }

double angleBetween(Point a, Point b) { return std::atan2(cross(a, b), glm::dot(a, b)); }

double extent(const Cubic& c) { return std::sqrt(squaredExtent(c)); }

Point startTangent(const Cubic& c) {
    const double tiny = vanishingSpeed * vanishingSpeed * squaredExtent(c);
    for (const Point p : {c.p1, c.p2})
        if (squaredDistance(c.p0, p) > tiny)
            return unit(p - c.p0);
    return unit(c.p3 - c.p0);
}

Point endTangent(const Cubic& c) { return -startTangent({c.p3, c.p2, c.p1, c.p0}); }

Point tangentAt(const Cubic& c, double t) {
    const Point d = c.derivative(t);
    if (t > 0 && t < 1 && d != Point{0, 0})
        return unit(d);
    return t < 0.5 ? startTangent(c) : endTangent(c);
}

Curvature curvature(const Cubic& c) {
    const Point a = 3.0 * (c.p1 - c.p0), b = 3.0 * (c.p2 - c.p1), d = 3.0 * (c.p3 - c.p2);
    return {{2 * cross(a, b), cross(a, d), 2 * cross(b, d)},
            {glm::dot(a, a), glm::dot(a, b), (2 * glm::dot(b, b) + glm::dot(a, d)) / 3, glm::dot(b, d),
             glm::dot(d, d)}};
}

double arcLength(const Cubic& c, double t0, double t1, double relativeError) {
    const double polygon = glm::distance(c.p0, c.p1) + glm::distance(c.p1, c.p2) + glm::distance(c.p2, c.p3);
    return geometry::arcLength(speedOf(c), t0, t1, relativeError * polygon);
}

double parameterAtLength(const Cubic& c, double t0, double length, double relativeError) {
    double low = t0, high = 1, t = t0, reached = 0;
    const double close = relativeError / 10 * extent(c);
    constexpr int maxSteps = 60;
    for (int i = 0; i < maxSteps; ++i) {
        const double missing = length - reached;
        if (std::abs(missing) <= close)
            break;
        (missing > 0 ? low : high) = t;
        const double speed = glm::length(c.derivative(t));
        double next = t + missing / speed;
        if (!(next > low && next < high))
            next = (low + high) / 2;
        if (next == t)
            break;
        t = next;
        reached = arcLength(c, t0, t, relativeError);
    }
    return t;
}

std::vector<Cubic> circleArc(Point center, Point from, double angle, double tolerance) {
    const geometry::EllipticalArc arc{center, from, perp(from), 0, angle};
    return geometry::cubics(arc,
                            geometry::cubicCount(arc, geometry::cubicArcAngle(glm::length(from), tolerance)));
}

Arc ellipticalArc(Point from, const scene::ArcTo& to, double tolerance) {
    if (from == to.to)
        return {};
    const auto arc = scene::centerForm(from, to);
    if (!arc)
        return {{geometry::straightCubic(from, to.to)}, {}};
    const double radius = std::max(glm::length(arc->axisX), glm::length(arc->axisY));
    Arc result{geometry::cubics(*arc, geometry::cubicCount(*arc, geometry::cubicArcAngle(radius, tolerance))),
               {}};
    result.pieces.front().p0 = from;
    result.pieces.back().p3 = to.to;
    if (to.radii.x == to.radii.y)
        result.circle = Circle{arc->center, radius};
    return result;
}

}  // namespace vtm::compiler::stroke
