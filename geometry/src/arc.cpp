#include "geometry/arc.hpp"

#include <algorithm>
#include <numbers>

namespace vtm::geometry {

namespace {

constexpr double turn = 2 * std::numbers::pi;

/// Whether the arc passes the angle.
bool passes(const EllipticalArc& arc, double angle) {
    const double offset = std::fmod(arc.sweep > 0 ? angle - arc.start : arc.start - angle, turn);
    return (offset < 0 ? offset + turn : offset) < std::abs(arc.sweep);
}

}  // namespace

std::optional<EllipticalArc> centerForm(const EndpointArc& arc) {
    Point radii = glm::abs(arc.radii);
    if (arc.from == arc.to || radii.x == 0 || radii.y == 0)
        return std::nullopt;
    const Point axis(std::cos(arc.rotation), std::sin(arc.rotation)), normal(-axis.y, axis.x);
    // Half the chord, from its middle to the start, where the ellipse is the unit circle.
    const Point half = (arc.from - arc.to) * 0.5;
    Point chord(glm::dot(half, axis) / radii.x, glm::dot(half, normal) / radii.y);
    const double square = glm::dot(chord, chord);
    if (!std::isfinite(square) || !std::isfinite(1 / square))
        return std::nullopt;
    const double growth = std::max(1.0, std::sqrt(square));
    radii *= growth;
    chord /= growth;
    const double height = square < 1 ? std::sqrt(1 / square - 1) : 0;
    const double side = arc.largeArc == arc.sweep ? -height : height;
    const Point center(side * chord.y, -side * chord.x);
    const Point first = chord - center, last = -chord - center;
    const double start = std::atan2(first.y, first.x);
    double sweep = std::atan2(last.y, last.x) - start;
    if (arc.sweep && sweep < 0)
        sweep += turn;
    if (!arc.sweep && sweep > 0)
        sweep -= turn;
    const Point x = axis * radii.x, y = normal * radii.y;
    return EllipticalArc{(arc.from + arc.to) * 0.5 + x * center.x + y * center.y, x, y, start, sweep};
}

EllipticalArc mapped(const EllipticalArc& arc, const glm::dmat3x2& map) {
    const auto linear = [&](Point v) { return map[0] * v.x + map[1] * v.y; };
    return {linear(arc.center) + map[2], linear(arc.axisX), linear(arc.axisY), arc.start, arc.sweep};
}

Box bounds(const EllipticalArc& arc) {
    Box box;
    box.add(arc.at(arc.start));
    box.add(arc.at(arc.start + arc.sweep));
    for (const double angle : {std::atan2(arc.axisY.x, arc.axisX.x), std::atan2(arc.axisY.y, arc.axisX.y)})
        for (const double extreme : {angle, angle + std::numbers::pi})
            if (passes(arc, extreme))
                box.add(arc.at(extreme));
    return box;
}

double cubicArcAngle(double radius, double tolerance) {
    // cubicArcError(), with cos²(angle / 4) >= 0.853 up to a quarter turn.
    const double sixth = 13.5 * 0.853 * tolerance / radius;
    constexpr double quarter = turn / 4;
    return sixth >= 1 ? quarter : std::min(quarter, 4 * std::asin(std::pow(sixth, 1.0 / 6)));
}

std::vector<Cubic> cubics(const EllipticalArc& arc, int count) {
    const double step = arc.sweep / count, arm = 4.0 / 3 * std::tan(step / 4);
    std::vector<Cubic> result;
    result.reserve(std::size_t(count));
    Point from = arc.at(arc.start);
    for (int i = 0; i < count; ++i) {
        const double a = arc.start + step * i, b = arc.start + arc.sweep * (i + 1) / count;
        const Point to = arc.at(b);
        result.push_back({from, from + arc.derivative(a) * arm, to - arc.derivative(b) * arm, to});
        from = to;
    }
    return result;
}

int cubicCount(const EllipticalArc& arc, double angle) {
    // A sweep of a whole number of angles must not get one more by rounding.
    constexpr double rounding = 1e-9;
    return std::max(1, int(std::ceil(std::abs(arc.sweep) / angle - rounding)));
}

}  // namespace vtm::geometry
