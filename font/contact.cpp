#include "font/contact.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/cubic.hpp"

namespace vtm::font {
namespace {

using geometry::Box;
using geometry::Cubic;
using scene::Point;

/// Chords of a curve: those of a quarter circle of radius 1/2 em are within 1/3700 em of it.
constexpr int chords = 24;
/// Outlines that come closer than this touch: more than the chords' error.
constexpr double nearness = 1.0 / 2000;

void addCurve(std::vector<Point>& ring, const Cubic& curve) {
    for (int i = 1; i <= chords; ++i)
        ring.push_back(curve.at(double(i) / chords));
}

double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }

double distanceToSegment(Point p, Point a, Point b) {
    const Point along = b - a;
    const double length = glm::dot(along, along);
    const double t = length > 0 ? std::clamp(glm::dot(p - a, along) / length, 0.0, 1.0) : 0;
    return glm::length(p - (a + along * t));
}

bool cross(Point a, Point b, Point c, Point d) {
    const double s = cross(b - a, c - a), t = cross(b - a, d - a), u = cross(d - c, a - c),
                 v = cross(d - c, b - c);
    return s * t < 0 && u * v < 0;
}

bool areNear(Point a, Point b, Point c, Point d) {
    return cross(a, b, c, d) || distanceToSegment(a, c, d) < nearness ||
           distanceToSegment(b, c, d) < nearness || distanceToSegment(c, a, b) < nearness ||
           distanceToSegment(d, a, b) < nearness;
}

Box boxOf(Point a, Point b) {
    Box box;
    box.add(a);
    box.add(b);
    return box;
}

Box widened(Box box) { return {box.min - nearness, box.max + nearness}; }
bool meet(const Box& a, const Box& b) { return !a.intersection(b).empty(); }

struct Segment {
    Point a, b;
};

/// Those that reach into the box.
std::vector<Segment> segmentsIn(const Polygons& polygons, Point by, const Box& box) {
    std::vector<Segment> segments;
    for (const std::vector<Point>& ring : polygons.rings)
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Segment s{ring[i] + by, ring[(i + 1) % ring.size()] + by};
            if (meet(boxOf(s.a, s.b), box))
                segments.push_back(s);
        }
    return segments;
}

bool isInside(Point p, const Polygons& polygons, Point by) {
    int winding = 0;
    for (const std::vector<Point>& ring : polygons.rings)
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Point a = ring[i] + by, b = ring[(i + 1) % ring.size()] + by;
            if ((a.y <= p.y) != (b.y <= p.y) && (cross(b - a, p - a) > 0) == (b.y > a.y))
                winding += b.y > a.y ? 1 : -1;
        }
    return winding != 0;
}

/// Whether a ring of one begins inside the other.
bool holds(const Polygons& outer, Point outerBy, const Polygons& inner, Point innerBy) {
    return std::ranges::any_of(inner.rings, [&](const std::vector<Point>& ring) {
        return isInside(ring.front() + innerBy, outer, outerBy);
    });
}

}  // namespace

Polygons::Polygons(const scene::Path& path) {
    Point at(0);
    for (const scene::Command& command : path) {
        if (const auto* move = std::get_if<scene::MoveTo>(&command))
            rings.push_back({move->to});
        else if (const auto* line = std::get_if<scene::LineTo>(&command))
            rings.back().push_back(line->to);
        else if (const auto* quad = std::get_if<scene::QuadTo>(&command))
            addCurve(rings.back(), geometry::raised(at, quad->control, quad->to));
        else if (const auto* cubic = std::get_if<scene::CubicTo>(&command))
            addCurve(rings.back(), {at, cubic->control1, cubic->control2, cubic->to});
        if (const auto end = scene::endOf(command))
            at = *end;
    }
    for (const std::vector<Point>& ring : rings)
        for (const Point p : ring)
            box.add(p);
}

bool touch(const Polygons& moved, Point by, const Polygons& other) {
    const Box movedBox = widened({moved.box.min + by, moved.box.max + by});
    const Box shared = movedBox.intersection(widened(other.box));
    if (shared.empty())
        return false;
    const std::vector<Segment> first = segmentsIn(moved, by, shared),
                               second = segmentsIn(other, Point(0), shared);
    for (const Segment& s : first) {
        const Box box = widened(boxOf(s.a, s.b));
        for (const Segment& t : second)
            if (meet(box, boxOf(t.a, t.b)) && areNear(s.a, s.b, t.a, t.b))
                return true;
    }
    return holds(moved, by, other, Point(0)) || holds(other, Point(0), moved, by);
}

}  // namespace vtm::font
