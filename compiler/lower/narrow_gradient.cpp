#include "compiler/lower/narrow_gradient.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

namespace vtm::compiler {
namespace {

using scene::Affine;
using scene::Color;
using scene::GradientStop;
using scene::Point;
using scene::Spread;

/// A picture that shows this much of a ramp has its stops placed to 2^-18 of its size in single precision.
constexpr double largeShare = 1.0 / 64;
/// Beyond what the picture shows, for filters.
constexpr double rangeMargin = 1.0 / 8;
/// Circles whose radius is as many times the picture's size are straight.
constexpr double straightRadius = 4096;

struct Range {
    double low, high;
    double size() const { return high - low; }
};

/// A stop where it stands on the unrolled ramp.
struct Stop {
    double at;
    Color color;
};

std::array<Point, 4> corners(glm::dvec2 size) {
    return {Point{0, 0}, Point{size.x, 0}, Point{0, size.y}, size};
}

Range shown(const Affine& toRamp, glm::dvec2 size) {
    Range range{toRamp[2].x, toRamp[2].x};
    for (const Point p : corners(size)) {
        const double u = scene::apply(toRamp, p).x;
        range.low = std::min(range.low, u), range.high = std::max(range.high, u);
    }
    const double more = rangeMargin * range.size();
    return {range.low - more, range.high + more};
}

Color hashCombine(const Color& a, const Color& b, double share) {
    const auto mix = [&](float x, float y) { return float(double(x) + (double(y) - double(x)) * share); };
    return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b), mix(a.a, b.a)};
}

/// One period, from `start` on; `isTurned`: from its end to its beginning.
void append(std::vector<Stop>& stops, const std::vector<GradientStop>& period, double start, bool isTurned) {
    const auto add = [&](double offset, const Color& color) {
        stops.push_back({start + (isTurned ? 1 - offset : offset), color});
    };
    std::vector<GradientStop> inOrder = period;
    if (isTurned)
        std::reverse(inOrder.begin(), inOrder.end());
    add(isTurned ? 1 : 0, inOrder.front().color);
    for (const GradientStop& s : inOrder)
        add(s.offset, s.color);
    add(isTurned ? 0 : 1, inOrder.back().color);
}

/// All stops that matter in the range.
std::vector<Stop> unrolled(const Ramp& ramp, const Range& range) {
    std::vector<Stop> stops;
    if (ramp.spread == Spread::Pad) {
        append(stops, ramp.stops, 0, false);
        return stops;
    }
    for (double k = std::floor(range.low); k <= std::floor(range.high); ++k)
        append(stops, ramp.stops, k, ramp.spread == Spread::Reflect && std::fmod(k, 2) != 0);
    return stops;
}

/// The colour at u, of stops that do not lie there.
Color colorAt(const std::vector<Stop>& stops, double u) {
    const auto above = std::ranges::upper_bound(stops, u, {}, &Stop::at);
    if (above == stops.begin())
        return stops.front().color;
    const Stop& below = *(above - 1);
    if (above == stops.end())
        return below.color;
    return hashCombine(below.color, above->color, (u - below.at) / (above->at - below.at));
}

std::vector<GradientStop> within(const std::vector<Stop>& stops, const Range& range) {
    std::vector<GradientStop> result{{0, colorAt(stops, range.low)}};
    for (const Stop& s : stops)
        if (s.at > range.low && s.at < range.high)
            result.push_back({float((s.at - range.low) / range.size()), s.color});
    result.push_back({1, colorAt(stops, range.high)});
    return result;
}

/// On which of the gradient's circles p lies: the larger u with |p - (1 - u) f| = (1 - u) fr + u.
struct Circle {
    double u, radius;
    Point fromCenter;  ///< to p
};
std::optional<Circle> circleThrough(Point p, Point f, double fr) {
    // |p - f + u f|² = (fr + u (1 - fr))²
    const Point d = p - f;
    const double a = glm::dot(f, f) - (1 - fr) * (1 - fr), b = glm::dot(d, f) - fr * (1 - fr),
                 c = glm::dot(d, d) - fr * fr;
    // Where the focal circle lies inside the end circle a < 0, so the larger root is this one.
    const double root = std::sqrt(b * b - a * c);
    const double u = (-b - root) / a;
    const double radius = fr + u * (1 - fr);
    if (!(a < 0) || !(radius > 0) || !std::isfinite(u))
        return std::nullopt;
    return Circle{u, radius, d + u * f};
}

}  // namespace

std::optional<Ramp> narrowed(const Ramp& ramp, glm::dvec2 size) {
    const Range range = shown(ramp.toRamp, size);
    if (!(range.size() > 0 && range.size() < largeShare))
        return std::nullopt;
    const double scale = 1 / range.size();
    const Point x = ramp.toRamp[0] * scale, y = ramp.toRamp[1] * scale;
    return Ramp{{x, y, {(ramp.toRamp[2].x - range.low) * scale, 0}},
                within(unrolled(ramp, range), range),
                Spread::Pad};
}

std::optional<Ramp> straightened(const scene::RadialGradient& gradient, const Affine& toUnit,
                                 glm::dvec2 size) {
    const Point middle = scene::apply(toUnit, size / 2.0),
                f = (gradient.focus - gradient.center) / gradient.radius;
    double extent = 0;
    for (const Point corner : corners(size))
        extent = std::max(extent, glm::distance(scene::apply(toUnit, corner), middle));
    const double fr = gradient.focalRadius / gradient.radius;
    const std::optional<Circle> circle = circleThrough(middle, f, fr);
    if (!circle || !(circle->radius > straightRadius * extent))
        return std::nullopt;
    // Of F(p, u) = |p - (1 - u) f|² - radius(u)² = 0, half of the derivatives.
    const double byU = glm::dot(circle->fromCenter, f) - circle->radius * (1 - fr);
    const Point slope = circle->fromCenter / -byU;
    if (!std::isfinite(slope.x) || !std::isfinite(slope.y))
        return std::nullopt;
    const Point x = toUnit[0], y = toUnit[1];
    const Point along{glm::dot(slope, x), glm::dot(slope, y)}, across{-along.y, along.x};
    const Affine toRamp{along.x, across.x, along.y, across.y, circle->u - glm::dot(along, size) / 2, 0};
    return Ramp{toRamp, gradient.stops, gradient.spread};
}

}  // namespace vtm::compiler
