#include "conformance/reference/outline/curve.hpp"

#include <numbers>

namespace vtm::reference {
namespace {

/// B.2.4: the arc's centre and angles in the ellipse's own frame. `radii` are positive.
Curve centerArc(Point from, const scene::ArcTo& arc, Vector radii) {
    const Vector axis{std::cos(arc.rotation), std::sin(arc.rotation)};
    const Vector half = (from - arc.to) / 2.0;
    Vector p{dot(half, axis) / radii.x, cross(axis, half) / radii.y};  // half the chord on the unit circle
    const double chord = dot(p, p);
    if (!(chord > 0) || !std::isfinite(chord))  // beyond what doubles can square
        return Line{from, arc.to};
    if (chord > 1) {  // B.2.5 step 3: radii too small are scaled up until the chord is a diameter
        radii *= std::sqrt(chord);
        p /= std::sqrt(chord);
    }
    const double height = std::sqrt(std::max(0.0, 1 / std::min(chord, 1.0) - 1));
    const Vector toCenter = (arc.largeArc != arc.sweep ? height : -height) * Vector(p.y, -p.x);
    const Vector startAt = p - toCenter, endAt = -p - toCenter;
    const double begin = std::atan2(startAt.y, startAt.x);
    double turn = std::atan2(endAt.y, endAt.x) - begin;
    if (arc.sweep && turn < 0)
        turn += 2 * std::numbers::pi;
    if (!arc.sweep && turn > 0)
        turn -= 2 * std::numbers::pi;
    const Vector axisX = radii.x * axis, axisY = radii.y * normalOf(axis);
    const Point center = (from + arc.to) / 2.0 + toCenter.x * axisX + toCenter.y * axisY;
    return Arc{center, axisX, axisY, begin, begin + turn, from, arc.to};
}

Curve curveOf(Point from, const scene::ArcTo& arc) {
    const Vector radii{std::abs(arc.radii.x), std::abs(arc.radii.y)};
    const bool straight = radii.x == 0 || radii.y == 0 || from == arc.to;
    return straight ? Curve(Line{from, arc.to}) : centerArc(from, arc, radii);
}

Curve curveOf(Point from, const scene::LineTo& line) { return Line{from, line.to}; }

Curve curveOf(Point from, const scene::CubicTo& cubic) {
    return Cubic{{from, cubic.control1, cubic.control2, cubic.to}};
}

/// Written so that a control point upon an end stays there: what rounding moved would be a tangent.
Curve curveOf(Point from, const scene::QuadTo& quad) {
    const auto towardsControl = [&](Point end) { return end + (quad.control - end) * (2.0 / 3); };
    return Cubic{{from, towardsControl(from), towardsControl(quad.to), quad.to}};
}

class Splitter {
public:
    void operator()(const scene::MoveTo& move) { begin(move.to); }

    void operator()(const scene::Close&) {
        if (afterClose_)
            begin(at_);
        const Point start = result_.back().start;
        if (at_ != start)
            result_.back().curves.push_back(Line{at_, start});
        result_.back().closed = true;
        afterClose_ = true;
        at_ = start;
    }

    template <class Draw>
    void operator()(const Draw& command) {
        if (afterClose_)
            begin(at_);
        result_.back().curves.push_back(curveOf(at_, command));
        at_ = command.to;
    }

    std::vector<Subpath> take() { return std::move(result_); }

private:
    void begin(Point start) {
        result_.push_back({start, {}, false});
        at_ = start;
        afterClose_ = false;
    }

    std::vector<Subpath> result_;
    Point at_{0, 0};
    bool afterClose_ = true;  // a path that does not begin with MoveTo begins at the origin
};

}  // namespace

Point startOf(const Curve& curve) {
    if (const auto* cubic = std::get_if<Cubic>(&curve))
        return cubic->p[0];
    const auto* line = std::get_if<Line>(&curve);
    return line ? line->from : std::get<Arc>(curve).from;
}

Point endOf(const Curve& curve) {
    if (const auto* cubic = std::get_if<Cubic>(&curve))
        return cubic->p[3];
    const auto* line = std::get_if<Line>(&curve);
    return line ? line->to : std::get<Arc>(curve).to;
}

std::vector<Subpath> subpaths(const scene::Path& path) {
    Splitter splitter;
    for (const scene::Command& command : path)
        std::visit(splitter, command);
    return splitter.take();
}

}  // namespace vtm::reference
