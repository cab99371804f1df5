#include "api/openvg/path/segment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <variant>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace vtm::openvg {

namespace {

constexpr std::array<int, 15> counts{0, 2, 2, 1, 1, 4, 6, 2, 4, 5, 5, 5, 5, 7, 10};
/// Of OpenVG 1.1.
constexpr std::size_t coreCommands = 13;

bool isLarge(const Segment& s) { return s.type == VG_LCCWARC_TO || s.type == VG_LCWARC_TO; }
bool isCounterClockwise(const Segment& s) { return s.type == VG_SCCWARC_TO || s.type == VG_LCCWARC_TO; }

Segment arcSegment(Point from, const scene::ArcTo& arc) {
    Segment s;
    s.type = arc.largeArc ? (arc.sweep ? VG_LCCWARC_TO : VG_LCWARC_TO)
                          : (arc.sweep ? VG_SCCWARC_TO : VG_SCWARC_TO);
    s.from = from;
    s.radii = arc.radii;
    s.rotation = glm::degrees(arc.rotation);
    s.to = arc.to;
    return s;
}

}  // namespace

int coordinateCount(unsigned segment) { return counts[segment >> 1]; }

bool isCommand(unsigned segment, bool knowsExtensions) {
    return segment >> 1 < (knowsExtensions ? counts.size() : coreCommands);
}

scene::Path outline(const std::vector<Segment>& segments) {
    if (std::ranges::any_of(segments, &Segment::isRational))
        return outline(withoutRationals(segments));
    scene::Path path;
    path.reserve(segments.size() + 1);
    if (!segments.empty() && segments.front().type != VG_MOVE_TO)
        path.emplace_back(scene::MoveTo{Point(0)});
    for (const Segment& s : segments) {
        switch (s.type) {
            case VG_CLOSE_PATH:
                path.emplace_back(scene::Close{});
                break;
            case VG_MOVE_TO:
                path.emplace_back(scene::MoveTo{s.to});
                break;
            case VG_LINE_TO:
                path.emplace_back(scene::LineTo{s.to});
                break;
            case VG_QUAD_TO:
                path.emplace_back(scene::QuadTo{s.control1, s.to});
                break;
            case VG_CUBIC_TO:
                path.emplace_back(scene::CubicTo{s.control1, s.control2, s.to});
                break;
            default:
                if (arcOf(s))
                    path.emplace_back(scene::ArcTo{glm::abs(s.radii),
                                                   glm::radians(std::fmod(s.rotation, 360.0)), isLarge(s),
                                                   isCounterClockwise(s), s.to});
                else
                    path.emplace_back(scene::LineTo{s.to});
                break;
        }
    }
    return path;
}

std::vector<Segment> segmentsOf(const scene::Path& outline) {
    std::vector<Segment> segments;
    segments.reserve(outline.size());
    Point start(0), at(0);
    for (const scene::Command& command : outline) {
        Segment s;
        s.from = at;
        s.to = scene::endOf(command).value_or(start);
        if (std::holds_alternative<scene::MoveTo>(command)) {
            s.type = VG_MOVE_TO;
            start = s.to;
        } else if (std::holds_alternative<scene::LineTo>(command)) {
            s.type = VG_LINE_TO;
        } else if (const auto* quad = std::get_if<scene::QuadTo>(&command)) {
            s.type = VG_QUAD_TO;
            s.control1 = quad->control;
        } else if (const auto* cubic = std::get_if<scene::CubicTo>(&command)) {
            s.type = VG_CUBIC_TO;
            s.control1 = cubic->control1;
            s.control2 = cubic->control2;
        } else if (const auto* arc = std::get_if<scene::ArcTo>(&command)) {
            s = arcSegment(at, *arc);
        }
        at = s.to;
        segments.push_back(s);
    }
    return segments;
}

std::optional<geometry::EllipticalArc> arcOf(const Segment& s) {
    if (!s.isArc())
        return std::nullopt;
    return geometry::centerForm({s.from, s.radii, glm::radians(std::fmod(s.rotation, 360.0)), isLarge(s),
                                 isCounterClockwise(s), s.to});
}

void transformEllipse(const glm::dmat2& linear, Point& radii, double& rotation) {
    // The image of the unit circle under M has the singular values of M as radii; by M Mᵀ = (a b; b d).
    const double angle = glm::radians(rotation), c = std::cos(angle), n = std::sin(angle);
    const glm::dvec2 x = linear * (radii.x * Point(c, n)), y = linear * (radii.y * Point(-n, c));
    const double a = x.x * x.x + y.x * y.x, b = x.x * x.y + y.x * y.y, d = x.y * x.y + y.y * y.y;
    const double mean = (a + d) / 2, spread = std::hypot((a - d) / 2, b);
    const double larger = std::sqrt(mean + spread);
    // The product of the radii is |det|, which keeps the smaller one exact.
    const double area = std::abs(x.x * y.y - x.y * y.x);
    radii = {larger, larger > 0 ? area / larger : 0};
    rotation = glm::degrees(0.5 * std::atan2(2 * b, a - d));
}

namespace {

using glm::dvec3;

constexpr double plainTolerance = 1.0 / (1 << 22);
/// A curve that reaches into the infinite is cut into 8 pieces: no number would be enough.
constexpr int maxEndlessHalvings = 3;
/// And followed so many sizes of its points' box.
constexpr double endlessReach = 64;

/// A number for what is none, and none that OpenVG does not know.
Point tame(Point p) {
    constexpr double farthest = std::numeric_limits<float>::max();
    const auto one = [&](double v) { return std::isnan(v) ? 0 : std::clamp(v, -farthest, farthest); };
    return {one(p.x), one(p.y)};
}

dvec3 homogeneous(Point p, double w) { return {w * p.x, w * p.y, w}; }

/// De Casteljau's scheme: of the halves of [0, 1] at t, the first or the second.
RationalCurve firstPart(RationalCurve c, double t) {
    const auto n = std::size_t(c.degree);
    for (std::size_t k = 1; k <= n; ++k)
        for (std::size_t i = n; i >= k; --i)
            c.points[i] = c.points[i - 1] + t * (c.points[i] - c.points[i - 1]);
    return c;
}
RationalCurve lastPart(RationalCurve c, double t) {
    const auto n = std::size_t(c.degree);
    for (std::size_t k = 1; k <= n; ++k)
        for (std::size_t i = 0; i + k <= n; ++i)
            c.points[i] = c.points[i] + t * (c.points[i + 1] - c.points[i]);
    return c;
}

/// An ellipse's arc of up to a quarter of a turn is a conic whose middle point lies where the tangents meet,
/// with the cosine of half the angle for a weight.
std::vector<RationalCurve> conics(const Segment& s, const geometry::EllipticalArc& arc) {
    const int count = geometry::cubicCount(arc, std::numbers::pi / 2);
    const double angle = arc.sweep / count, weight = std::cos(angle / 2);
    std::vector<RationalCurve> curves;
    dvec3 start = homogeneous(s.from, 1);
    for (int i = 0; i < count; ++i) {
        const double middle = arc.start + (i + 0.5) * angle;
        const Point tip = arc.center + (arc.at(middle) - arc.center) / weight;
        const Point end = i + 1 == count ? s.to : arc.at(arc.start + (i + 1) * angle);
        curves.push_back({2, {start, homogeneous(tip, weight), homogeneous(end, 1)}});
        start = curves.back().end();
    }
    return curves;
}

bool isEndless(const RationalCurve& c) {
    return !std::all_of(c.points.begin(), c.points.begin() + c.degree + 1, [](dvec3 p) { return p.z > 0; });
}

bool isPlain(const RationalCurve& c) {
    return std::all_of(c.points.begin() + 1, c.points.begin() + c.degree + 1,
                       [&](dvec3 p) { return p.z == c.points[0].z; });
}

}  // namespace

dvec3 RationalCurve::at(double t) const { return firstPart(*this, t).end(); }

Point RationalCurve::derivative(double t) const {
    // What is left at the start or the end, q being next to p: n (w q / w p) (q - p).
    const bool isStart = t < 0.5;
    const RationalCurve rest = isStart ? lastPart(*this, t) : firstPart(*this, t);
    const auto n = std::size_t(degree);
    const dvec3 p = isStart ? rest.points[0] : rest.points[n],
                q = isStart ? rest.points[1] : rest.points[n - 1];
    const Point change = double(degree) * (glm::dvec2(q) - q.z * projected(p)) / p.z;
    return isStart ? change / (1 - t) : -change / t;
}

RationalCurve RationalCurve::part(double first, double last) const {
    RationalCurve result = last < 1 ? firstPart(*this, last) : *this;
    return first > 0 ? lastPart(result, first / last) : result;
}

std::vector<RationalCurve> rationalCurves(const Segment& s) {
    const dvec3 from = homogeneous(s.from, 1), to = homogeneous(s.to, 1);
    const auto& w = s.weights;
    // All weights the other way round are the same curve.
    const double sign = w[0] < 0 ? -1 : 1;
    switch (s.type) {
        case VG_MOVE_TO:
            return {};
        case VG_QUAD_TO:
            return {{2, {from, homogeneous(s.control1, 1), to}}};
        case VG_CUBIC_TO:
            return {{3, {from, homogeneous(s.control1, 1), homogeneous(s.control2, 1), to}}};
        case VG_RQUAD_TO_NDS:
            return {{2,
                     {homogeneous(s.from, sign * w[0]), homogeneous(s.control1, sign * w[1]),
                      homogeneous(s.to, sign * w[2])}}};
        case VG_RCUBIC_TO_NDS:
            return {{3,
                     {homogeneous(s.from, sign * w[0]), homogeneous(s.control1, sign * w[1]),
                      homogeneous(s.control2, sign * w[2]), homogeneous(s.to, sign * w[3])}}};
        default:
            break;
    }
    if (const auto arc = arcOf(s))
        return conics(s, *arc);
    return {{1, {from, to}}};
}

Point projected(dvec3 p) { return tame({p.x / p.z, p.y / p.z}); }

Segment segmentOf(const RationalCurve& c) {
    Segment s;
    s.from = projected(c.start());
    s.to = projected(c.end());
    if (c.degree == 1) {
        s.type = VG_LINE_TO;
        return s;
    }
    if (!isPlain(c) || c.start().z != 1)
        s.type = c.degree == 2 ? VG_RQUAD_TO_NDS : VG_RCUBIC_TO_NDS;
    else
        s.type = c.degree == 2 ? VG_QUAD_TO : VG_CUBIC_TO;
    s.control1 = projected(c.points[1]);
    s.control2 = projected(c.points[2]);
    for (std::size_t i = 0; i <= std::size_t(c.degree); ++i)
        s.weights[i] = c.points[i].z;
    return s;
}

void appendAsPlain(std::vector<Segment>& segments, const RationalCurve& c, double tolerance, int halvings) {
    if (c.degree == 1 || isPlain(c)) {
        segments.push_back(segmentOf(c));
        if (segments.back().isRational())
            segments.back().type = c.degree == 2 ? VG_QUAD_TO : VG_CUBIC_TO;
        return;
    }
    Segment cubic;
    cubic.type = VG_CUBIC_TO;
    cubic.from = projected(c.start());
    cubic.to = projected(c.end());
    cubic.control1 = tame(cubic.from + c.derivative(0) / 3.0);
    cubic.control2 = tame(cubic.to - c.derivative(1) / 3.0);
    const RationalCurve plain{3,
                              {homogeneous(cubic.from, 1), homogeneous(cubic.control1, 1),
                               homogeneous(cubic.control2, 1), homogeneous(cubic.to, 1)}};
    const bool isNear = std::ranges::all_of(std::array{0.25, 0.5, 0.75}, [&](double t) {
        return glm::distance(projected(c.at(t)), projected(plain.at(t))) <= tolerance;
    });
    if (isNear || halvings == 0) {
        if (!isNear)
            cubic.type = VG_LINE_TO;
        segments.push_back(cubic);
        return;
    }
    appendAsPlain(segments, firstPart(c, 0.5), tolerance, halvings - 1);
    appendAsPlain(segments, lastPart(c, 0.5), tolerance, halvings - 1);
}

std::vector<Segment> withoutRationals(std::span<const Segment> segments) {
    std::vector<Segment> plain;
    plain.reserve(segments.size());
    for (const Segment& s : segments) {
        if (!s.isRational()) {
            plain.push_back(s);
            continue;
        }
        const Point last = s.type == VG_RCUBIC_TO_NDS ? s.control2 : s.control1;
        const Point minimum = glm::min(glm::min(s.from, s.to), glm::min(s.control1, last)),
                    maximum = glm::max(glm::max(s.from, s.to), glm::max(s.control1, last));
        const std::size_t first = plain.size();
        const RationalCurve curve = rationalCurves(s).front();
        appendAsPlain(plain, curve, plainTolerance * glm::distance(minimum, maximum),
                      isEndless(curve) ? maxEndlessHalvings : maxHalvings);
        // A curve with weights above 0 stays in its points' box.
        const Point reach = endlessReach * (maximum - minimum);
        for (std::size_t i = first; i < plain.size(); ++i)
            for (Point* p : {&plain[i].control1, &plain[i].control2, &plain[i].to})
                *p = glm::clamp(*p, tame(minimum - reach), tame(maximum + reach));
        // Just where the segment ends, though its last weight be 0.
        plain.back().to = s.to;
    }
    return plain;
}

}  // namespace vtm::openvg
