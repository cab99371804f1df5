#include "api/openvg/path/path_measure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>

#include "api/openvg/path/segment.hpp"
#include "geometry/length.hpp"

namespace vtm::openvg {

namespace {

constexpr double lengthTolerance = 1e-7;

/// A segment as a curve over t from 0 to 1.
class Curve {
public:
    explicit Curve(const Segment& s) : s_(s), arc_(arcOf(s)) {}

    bool isStraight() const { return s_.type != VG_QUAD_TO && s_.type != VG_CUBIC_TO && !arc_; }

    Point at(double t) const {
        const double r = 1 - t;
        if (t >= 1)
            return s_.to;
        if (s_.type == VG_QUAD_TO)
            return r * r * s_.from + 2 * r * t * s_.control1 + t * t * s_.to;
        if (s_.type == VG_CUBIC_TO)
            return r * r * r * s_.from + 3 * r * r * t * s_.control1 + 3 * r * t * t * s_.control2 +
                   t * t * t * s_.to;
        if (arc_)
            return arc_->at(arc_->start + t * arc_->sweep);
        return s_.from + t * (s_.to - s_.from);
    }

    Point derivative(double t) const {
        const double r = 1 - t;
        if (s_.type == VG_QUAD_TO)
            return 2.0 * (r * (s_.control1 - s_.from) + t * (s_.to - s_.control1));
        if (s_.type == VG_CUBIC_TO)
            return 3.0 * (r * r * (s_.control1 - s_.from) + 2 * r * t * (s_.control2 - s_.control1) +
                          t * t * (s_.to - s_.control2));
        if (arc_)
            return arc_->sweep * arc_->derivative(arc_->start + t * arc_->sweep);
        return s_.to - s_.from;
    }

    /// Directions of travel on leaving t = 0 and on arriving at t = 1; nothing for a curve that is a point.
    std::optional<Point> outgoing() const {
        return firstDirection({s_.from, s_.control1, s_.control2, s_.to}, 0);
    }
    std::optional<Point> incoming() const {
        std::optional<Point> d = firstDirection({s_.to, s_.control2, s_.control1, s_.from}, 1);
        if (d)
            d = -*d;
        return d;
    }

    /// From t = 0 to t.
    double length(double t = 1) const {
        if (isStraight())
            return t * glm::length(s_.to - s_.from);
        const auto speed = [&](double u) { return glm::length(derivative(u)); };
        // A start that no symmetry fools.
        double sum = 0;
        constexpr int parts = 4;
        for (int i = 0; i < parts; ++i)
            sum += geometry::relativeArcLength(speed, t * i / parts, t * (i + 1) / parts, lengthTolerance);
        return sum;
    }

    /// Where the length from t = 0 is `wanted`, of a curve that is `whole` long.
    double parameterAt(double wanted, double whole) const {
        if (isStraight())
            return whole > 0 ? wanted / whole : 0;
        double low = 0, high = 1;
        for (int i = 0; i < 40; ++i) {
            const double middle = (low + high) / 2;
            (length(middle) < wanted ? low : high) = middle;
        }
        return (low + high) / 2;
    }

private:
    /// Towards the first point, going from p[0], that is not p[0].
    std::optional<Point> firstDirection(std::array<Point, 4> p, double t) const {
        if (arc_)
            return glm::normalize(t == 0 ? derivative(0) : -derivative(1));
        if (isStraight())
            p[1] = p[2] = p[3];
        else if (s_.type == VG_QUAD_TO)
            p[1] = p[2] = s_.control1;
        for (std::size_t i = 1; i < 4; ++i)
            if (p[i] != p[0])
                return glm::normalize(p[i] - p[0]);
        return std::nullopt;
    }

    Segment s_;
    std::optional<geometry::EllipticalArc> arc_;
};

double lengthOf(const Segment& s) { return s.type == VG_MOVE_TO ? 0 : Curve(s).length(); }

std::optional<Point> incomingOf(const Segment& s) {
    return s.type == VG_MOVE_TO ? std::nullopt : Curve(s).incoming();
}
std::optional<Point> outgoingOf(const Segment& s) {
    return s.type == VG_MOVE_TO ? std::nullopt : Curve(s).outgoing();
}

}  // namespace

double length(std::span<const Segment> segments) {
    double sum = 0;
    for (const Segment& s : withoutRationals(segments))
        sum += lengthOf(s);
    return sum;
}

PointOnPath pointAlong(std::span<const Segment> segments, std::size_t first, std::size_t count,
                       double distance) {
    const std::vector<Segment> part = withoutRationals(segments.subspan(first, count));
    // The tangent at the end of segment i - 1, or where there is none, the next that goes out.
    const auto tangentAt = [&](std::size_t i) {
        for (std::size_t k = i; k > 0; --k)
            if (const auto tangent = incomingOf(part[k - 1]))
                return *tangent;
        for (std::size_t k = i; k < part.size(); ++k)
            if (const auto tangent = outgoingOf(part[k]))
                return *tangent;
        return Point(1, 0);
    };
    // Where the path starts to draw; moves alone have no point.
    const auto start = std::ranges::find_if(part, [](const Segment& s) { return s.type != VG_MOVE_TO; });
    if (start == part.end())
        return {};
    if (!(distance > 0))
        return {start->from, tangentAt(0)};
    double done = 0;
    std::size_t lastDrawn = part.size();
    for (std::size_t i = 0; i < part.size(); ++i) {
        const double own = lengthOf(part[i]);
        if (own > 0) {
            lastDrawn = i;
            if (distance < done + own) {
                const Curve curve(part[i]);
                const double t = curve.parameterAt(distance - done, own);
                const Point d = curve.derivative(t);
                const double speed = glm::length(d);
                return {curve.at(t), speed > 0 ? d / speed : tangentAt(i + 1)};
            }
            done += own;
        }
    }
    // The end of what is seen: moves after the last line draw nothing.
    if (lastDrawn == part.size())
        return {start->to, tangentAt(part.size())};
    return {part[lastDrawn].to, tangentAt(lastDrawn + 1)};
}

geometry::Box bounds(std::span<const Segment> segments, const glm::mat3& affine) {
    const glm::dmat3x2 map(affine);
    const auto mapped = [&](Point p) { return map[0] * p.x + map[1] * p.y + map[2]; };
    geometry::Box box;
    for (const Segment& s : withoutRationals(segments)) {
        const Point from = mapped(s.from), to = mapped(s.to);
        if (s.type != VG_MOVE_TO)
            box.add(from);
        box.add(to);
        if (s.type == VG_QUAD_TO)
            box.add(geometry::bounds(geometry::raised(from, mapped(s.control1), to)));
        else if (s.type == VG_CUBIC_TO)
            box.add(geometry::bounds({from, mapped(s.control1), mapped(s.control2), to}));
        else if (const auto arc = arcOf(s))
            box.add(geometry::bounds(geometry::mapped(*arc, map)));
    }
    return box;
}

}  // namespace vtm::openvg
