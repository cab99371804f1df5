#include "api/openvg/path/path_measure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>

#include "api/openvg/path/rational_curve.hpp"

namespace vtm::openvg {

namespace {

constexpr double lengthTolerance = 1e-7;
constexpr int deepestHalving = 20;

/// A segment as a curve over t from 0 to 1.
class Curve {
public:
    explicit Curve(const Segment& s) : s_(s), isEllipse_(s.isArc() && arcOf(s, arc_)) {}

    bool isStraight() const { return s_.type != VG_QUAD_TO && s_.type != VG_CUBIC_TO && !isEllipse_; }

    Point at(double t) const {
        const double r = 1 - t;
        if (t >= 1)
            return s_.to;
        if (s_.type == VG_QUAD_TO)
            return r * r * s_.from + 2 * r * t * s_.control1 + t * t * s_.to;
        if (s_.type == VG_CUBIC_TO)
            return r * r * r * s_.from + 3 * r * r * t * s_.control1 + 3 * r * t * t * s_.control2 +
                   t * t * t * s_.to;
        if (isEllipse_)
            return arc_.at(arc_.start + t * arc_.sweep);
        return s_.from + t * (s_.to - s_.from);
    }

    Point derivative(double t) const {
        const double r = 1 - t;
        if (s_.type == VG_QUAD_TO)
            return 2.0 * (r * (s_.control1 - s_.from) + t * (s_.to - s_.control1));
        if (s_.type == VG_CUBIC_TO)
            return 3.0 * (r * r * (s_.control1 - s_.from) + 2 * r * t * (s_.control2 - s_.control1) +
                          t * t * (s_.to - s_.control2));
        if (isEllipse_)
            return arc_.sweep * arc_.derivative(arc_.start + t * arc_.sweep);
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
        // A start that no symmetry fools.
        double sum = 0;
        constexpr int parts = 4;
        for (int i = 0; i < parts; ++i)
            sum += integral(t * i / parts, t * (i + 1) / parts, 0);
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
        if (isEllipse_)
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

    /// Gauss's rule of five points.
    double gauss(double a, double b) const {
        constexpr std::array<double, 3> x{0, 0.5384693101056831, 0.9061798459386640};
        constexpr std::array<double, 3> w{0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
        const double half = (b - a) / 2, middle = (a + b) / 2;
        double sum = w[0] * glm::length(derivative(middle));
        for (std::size_t i = 1; i < 3; ++i)
            sum += w[i] * (glm::length(derivative(middle - half * x[i])) +
                           glm::length(derivative(middle + half * x[i])));
        return sum * half;
    }

    double integral(double a, double b, int depth) const {
        const double whole = gauss(a, b), middle = (a + b) / 2;
        const double halves = gauss(a, middle) + gauss(middle, b);
        if (depth == deepestHalving || !(std::abs(whole - halves) > lengthTolerance * halves))
            return halves;
        return integral(a, middle, depth + 1) + integral(middle, b, depth + 1);
    }

    Segment s_;
    EllipticalArc arc_;
    bool isEllipse_;
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

PathBounds bounds(std::span<const Segment> segments, const glm::mat3& affine) {
    const glm::dmat3 m(affine);
    PathBounds box;
    const auto take = [&](Point p) {
        const Point q(m * glm::dvec3(p, 1));
        box.min = box.isEmpty ? q : glm::min(box.min, q);
        box.max = box.isEmpty ? q : glm::max(box.max, q);
        box.isEmpty = false;
    };
    for (const Segment& s : withoutRationals(segments)) {
        if (s.type != VG_MOVE_TO)
            take(s.from);
        take(s.to);
        const Curve curve(s);
        // Where the image runs along an axis its derivative has a 0 in the other.
        for (int axis = 0; axis < 2; ++axis) {
            const auto mapped = [&](Point v) { return m[0][axis] * v.x + m[1][axis] * v.y; };
            if (s.type == VG_QUAD_TO) {
                const double a = mapped(s.from), b = mapped(s.control1), c = mapped(s.to), d = a - 2 * b + c;
                const double t = (a - b) / d;
                if (t > 0 && t < 1)
                    take(curve.at(t));
            } else if (s.type == VG_CUBIC_TO) {
                const double p0 = mapped(s.from), p1 = mapped(s.control1), p2 = mapped(s.control2),
                             p3 = mapped(s.to);
                const double a = p3 - 3 * p2 + 3 * p1 - p0, b = 2 * (p2 - 2 * p1 + p0), c = p1 - p0;
                // a t² + b t + c = 0, by the root that does not cancel first.
                const double discriminant = b * b - 4 * a * c;
                if (discriminant < 0)
                    continue;
                const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
                for (const double t : {q / a, c / q})
                    if (t > 0 && t < 1)
                        take(curve.at(t));
            } else if (EllipticalArc arc; s.isArc() && arcOf(s, arc)) {
                const double turn = std::atan2(mapped(arc.axisY), mapped(arc.axisX));
                constexpr double half = 3.14159265358979323846;
                const double low = std::min(arc.start, arc.start + arc.sweep),
                             high = std::max(arc.start, arc.start + arc.sweep);
                for (double t = turn + half * std::ceil((low - turn) / half); t < high; t += half)
                    take(arc.at(t));
            }
        }
    }
    return box;
}

}  // namespace vtm::openvg
