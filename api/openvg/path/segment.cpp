#include "api/openvg/path/segment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "api/openvg/path/rational_curve.hpp"

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

}  // namespace vtm::openvg
