#include "compiler/stroke/curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace vtm::compiler::stroke {

namespace {

/// Speeds below this share of the curve's extent carry no direction any more: rounding errors of
/// about 1e-16 leave seven digits of a tangent at this length.
constexpr double vanishingSpeed = 1e-9;

Point lerp(Point a, Point b, double t) { return a + (b - a) * t; }

/// Gauss-Legendre with eight points: positive abscissae and their weights on [-1, 1].
constexpr std::array<std::array<double, 2>, 4> gauss8{{{0.1834346424956498, 0.3626837833783620},
                                                       {0.5255324099163290, 0.3137066458778873},
                                                       {0.7966664774136267, 0.2223810344533745},
                                                       {0.9602898564975363, 0.1012285362903763}}};

double gaussLength(const Cubic& c, double t0, double t1) {
    const double mid = (t0 + t1) / 2, half = (t1 - t0) / 2;
    double sum = 0;
    for (const auto& [x, w] : gauss8)
        sum +=
            w * (glm::length(derivativeAt(c, mid - half * x)) + glm::length(derivativeAt(c, mid + half * x)));
    return sum * half;
}

double adaptiveLength(const Cubic& c, double t0, double t1, double whole, double tolerance, int depth) {
    const double mid = (t0 + t1) / 2;
    const double left = gaussLength(c, t0, mid), right = gaussLength(c, mid, t1);
    constexpr double roundings = 1e-15;  // of a sum of sixteen: closer it does not come
    if (depth == 0 || std::abs(left + right - whole) <= std::max(tolerance, roundings * whole))
        return left + right;
    return adaptiveLength(c, t0, mid, left, tolerance / 2, depth - 1) +
           adaptiveLength(c, mid, t1, right, tolerance / 2, depth - 1);
}

}  // namespace

Point rotate(Point v, double angle) { return v * std::cos(angle) + perp(v) * std::sin(angle); }

double angleBetween(Point a, Point b) { return std::atan2(cross(a, b), glm::dot(a, b)); }

Cubic straightCubic(Point from, Point to) {
    return {from, lerp(from, to, 1.0 / 3), lerp(from, to, 2.0 / 3), to};
}

Cubic elevate(Point from, Point control, Point to) {
    return {from, lerp(from, control, 2.0 / 3), lerp(to, control, 2.0 / 3), to};
}

Cubic part(const Cubic& c, double t0, double t1) {
    const double third = (t1 - t0) / 3;
    const Point a = t0 == 0 ? c.p0 : pointAt(c, t0), b = t1 == 1 ? c.p3 : pointAt(c, t1);
    return {a, a + derivativeAt(c, t0) * third, b - derivativeAt(c, t1) * third, b};
}

double extent(const Cubic& c) {
    return std::max({glm::distance(c.p0, c.p1), glm::distance(c.p0, c.p2), glm::distance(c.p0, c.p3)});
}

Point startTangent(const Cubic& c) {
    const double tiny = vanishingSpeed * extent(c);
    for (const Point p : {c.p1, c.p2})
        if (glm::distance(p, c.p0) > tiny)
            return unit(p - c.p0);
    return unit(c.p3 - c.p0);
}

Point endTangent(const Cubic& c) { return -startTangent({c.p3, c.p2, c.p1, c.p0}); }

Point tangentAt(const Cubic& c, double t) {
    const Point d = derivativeAt(c, t);
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
    constexpr int maxDepth = 24;  // a cusp halves the step once a level; 2^-24 of a curve is negligible
    const double polygon = glm::distance(c.p0, c.p1) + glm::distance(c.p1, c.p2) + glm::distance(c.p2, c.p3);
    return adaptiveLength(c, t0, t1, gaussLength(c, t0, t1), relativeError * polygon, maxDepth);
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
        const double speed = glm::length(derivativeAt(c, t));
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

double arcStep(double radius, double tolerance) {
    // A cubic with arms 4/3·tan(φ/4) leaves the unit circle by 2/27·sin⁶(φ/4)/cos²(φ/4)
    // (Goldapp 1991); cos²(φ/4) >= 0.853 up to a quarter turn.
    const double sixth = 13.5 * 0.853 * tolerance / radius;
    constexpr double quarter = std::numbers::pi / 2;
    return sixth >= 1 ? quarter : std::min(quarter, 4 * std::asin(std::pow(sixth, 1.0 / 6)));
}

namespace {

/// Arc of the circle (cos, sin) under the linear map with columns x, y, moved to `center`.
std::vector<Cubic> mappedArc(Point center, Point x, Point y, double start, double angle, double step) {
    const auto at = [&](double a) { return center + x * std::cos(a) + y * std::sin(a); };
    const auto slope = [&](double a) { return y * std::cos(a) - x * std::sin(a); };
    // An angle that is a whole number of steps must not get one more by rounding.
    const int count = std::max(1, int(std::ceil(std::abs(angle) / step - 1e-9)));
    const double arm = 4.0 / 3 * std::tan(angle / count / 4);
    std::vector<Cubic> result;
    for (int i = 0; i < count; ++i) {
        const double a = start + angle * i / count, b = start + angle * (i + 1) / count;
        result.push_back({at(a), at(a) + slope(a) * arm, at(b) - slope(b) * arm, at(b)});
    }
    return result;
}

}  // namespace

std::vector<Cubic> circleArc(Point center, Point from, double angle, double tolerance) {
    return mappedArc(center, from, perp(from), 0, angle, arcStep(glm::length(from), tolerance));
}

Arc ellipticalArc(Point from, const scene::ArcTo& arc, double tolerance) {
    if (from == arc.to)
        return {};
    Point radii = glm::abs(arc.radii);
    // In the frame where the ellipse is the unit circle, the chord is from `half` to -`half`.
    Point half = rotate((from - arc.to) / 2.0, -arc.rotation) / radii;
    const double square = glm::dot(half, half);
    if (radii.x == 0 || radii.y == 0 || !std::isfinite(1 / square))
        return {{straightCubic(from, arc.to)}, {}};
    const double growth = std::max(1.0, std::sqrt(square));
    radii *= growth;
    half /= growth;
    const double height = square < 1 ? std::sqrt(1 / square - 1) : 0;
    const Point toCenter = perp(half) * (arc.largeArc == arc.sweep ? height : -height);
    const Point start = half - toCenter;
    double angle = angleBetween(start, -half - toCenter);
    if (arc.sweep != (angle > 0))
        angle += arc.sweep ? 2 * std::numbers::pi : -2 * std::numbers::pi;
    const Point x = rotate({radii.x, 0}, arc.rotation), y = rotate({0, radii.y}, arc.rotation);
    const Point center = (from + arc.to) / 2.0 + x * toCenter.x + y * toCenter.y;
    Arc result{mappedArc(center, x, y, std::atan2(start.y, start.x), angle,
                         arcStep(std::max(radii.x, radii.y), tolerance)),
               {}};
    result.pieces.front().p0 = from;
    result.pieces.back().p3 = arc.to;
    if (radii.x == radii.y)
        result.circle = Circle{center, radii.x};
    return result;
}

}  // namespace vtm::compiler::stroke
