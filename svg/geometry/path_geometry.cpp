#include "svg/geometry/path_geometry.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "svg/geometry/segments.hpp"

namespace vtm::svg {
namespace {

using scene::Affine;
using scene::Path;
using scene::Point;

/// Where the derivative of a cubic in one dimension vanishes inside ]0, 1[.
void addExtrema(double p0, double p1, double p2, double p3, std::vector<double>& out) {
    const double a = p3 - 3 * p2 + 3 * p1 - p0, b = 2 * (p2 - 2 * p1 + p0), c = p1 - p0;
    const auto add = [&](double t) {
        if (t > 0 && t < 1)
            out.push_back(t);
    };
    const double discriminant = b * b - 4 * a * c;
    if (discriminant < 0)
        return;
    // The stable pair of roots: q / a and c / q. Divisions by zero give infinities, which add() drops.
    const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
    add(q / a);
    add(c / q);
}

struct BoxBuilder {
    const Affine& transform;
    Box box;

    Point map(Point p) const { return scene::apply(transform, p); }
    void operator()(const MoveSegment& move) { box.add(map(move.to)); }
    void operator()(const LineSegment& line) { box.add(map(line.to)); }
    void operator()(const CubicSegment& mapped) {
        const CubicSegment cubic{map(mapped.from), map(mapped.control1), map(mapped.control2),
                                 map(mapped.to)};
        box.add(cubic.to);
        std::vector<double> parameters;
        addExtrema(cubic.from.x, cubic.control1.x, cubic.control2.x, cubic.to.x, parameters);
        addExtrema(cubic.from.y, cubic.control1.y, cubic.control2.y, cubic.to.y, parameters);
        for (const double t : parameters)
            box.add(cubic.at(t));
    }
    void operator()(const ArcSegment& arc) {
        box.add(map(arc.to));
        const Point u = scene::applyVector(transform, arc.arc.u),
                    v = scene::applyVector(transform, arc.arc.v);
        for (const double angle : {std::atan2(v.x, u.x), std::atan2(v.y, u.y)})
            for (const double turned : {angle, angle + std::numbers::pi})
                if (isInside(arc.arc, turned))
                    box.add(map(arc.arc.at(turned)));
    }
    static bool isInside(const CenterArc& arc, double angle) {
        const double turn = 2 * std::numbers::pi;
        double offset = std::fmod(arc.sweep > 0 ? angle - arc.start : arc.start - angle, turn);
        offset += offset < 0 ? turn : 0;
        return offset < std::abs(arc.sweep);
    }
};

struct LengthSum {
    /// Chords a curve: the error of n chords falls with 1 / n².
    static constexpr int chords = 64;
    double sum = 0;

    void operator()(const MoveSegment&) {}
    void operator()(const LineSegment& line) { sum += glm::distance(line.from, line.to); }
    void operator()(const CubicSegment& cubic) {
        add([&](double t) { return cubic.at(t); });
    }
    void operator()(const ArcSegment& arc) {
        add([&](double t) { return arc.arc.at(arc.arc.start + t * arc.arc.sweep); });
    }
    template <class Curve>
    void add(Curve curve) {
        Point last = curve(0);
        for (int i = 1; i <= chords; ++i) {
            const Point next = curve(static_cast<double>(i) / chords);
            sum += glm::distance(last, next);
            last = next;
        }
    }
};

void appendMappedArc(const Affine& m, const CenterArc& arc, Path& out) {
    // Pieces of at most 45 degrees, each within 4e-6 of the radius.
    const int pieces =
        std::max(1, static_cast<int>(std::ceil(std::abs(arc.sweep) / (std::numbers::pi / 4) - 1e-9)));
    const double step = arc.sweep / pieces, handle = 4.0 / 3 * std::tan(step / 4);
    for (int i = 0; i < pieces; ++i) {
        const double a = arc.start + i * step, b = a + step;
        out.push_back(scene::CubicTo{scene::apply(m, arc.at(a) + handle * arc.direction(a)),
                                     scene::apply(m, arc.at(b) - handle * arc.direction(b)),
                                     scene::apply(m, arc.at(b))});
    }
}

struct PathMapper {
    const Affine& transform;
    Path out;

    Point map(Point p) const { return scene::apply(transform, p); }
    void operator()(const MoveSegment& move) { out.push_back(scene::MoveTo{map(move.to)}); }
    void operator()(const LineSegment& line) {
        if (line.closes)
            out.push_back(scene::Close{});
        else
            out.push_back(scene::LineTo{map(line.to)});
    }
    void operator()(const CubicSegment& cubic) {
        out.push_back(scene::CubicTo{map(cubic.control1), map(cubic.control2), map(cubic.to)});
    }
    void operator()(const ArcSegment& arc) { appendMappedArc(transform, arc.arc, out); }
};

}  // namespace

void Box::add(Point p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
}

void Box::add(const Box& other) {
    min = glm::min(min, other.min);
    max = glm::max(max, other.max);
}

bool Box::contains(const Box& other) const {
    return other.empty() ||
           (min.x <= other.min.x && min.y <= other.min.y && max.x >= other.max.x && max.y >= other.max.y);
}

Affine unitSquareTo(const Box& box) { return {box.width(), 0, 0, box.height(), box.min.x, box.min.y}; }

Box mapBox(const Affine& transform, const Box& box) {
    Box mapped;
    if (!box.empty())
        for (const Point corner :
             {box.min, Point(box.max.x, box.min.y), box.max, Point(box.min.x, box.max.y)})
            mapped.add(scene::apply(transform, corner));
    return mapped;
}

Point CenterArc::at(double angle) const { return center + std::cos(angle) * u + std::sin(angle) * v; }

Point CenterArc::direction(double angle) const { return std::cos(angle) * v - std::sin(angle) * u; }

std::optional<CenterArc> centerForm(Point from, const scene::ArcTo& arc) {
    Point radii = glm::abs(arc.radii);
    if (from == arc.to || radii.x == 0 || radii.y == 0)
        return std::nullopt;
    const Point axisX(std::cos(arc.rotation), std::sin(arc.rotation)), axisY(-axisX.y, axisX.x);
    // The chord's half in units of the radii, where the ellipse is a unit circle.
    const Point half = 0.5 * (from - arc.to);
    Point chord(glm::dot(half, axisX) / radii.x, glm::dot(half, axisY) / radii.y);
    const double size = glm::dot(chord, chord);
    if (!(size > 0) || !std::isfinite(size))
        return std::nullopt;
    if (size > 1) {
        radii *= std::sqrt(size);
        chord /= std::sqrt(size);
    }
    const double distance = std::sqrt(std::max(0.0, 1 / glm::dot(chord, chord) - 1));
    const double side = arc.largeArc != arc.sweep ? 1 : -1;
    const Point center = side * distance * Point(chord.y, -chord.x);
    const Point first = chord - center, last = -chord - center;
    const double start = std::atan2(first.y, first.x);
    double sweep = std::atan2(last.y, last.x) - start;
    if (arc.sweep && sweep < 0)
        sweep += 2 * std::numbers::pi;
    if (!arc.sweep && sweep > 0)
        sweep -= 2 * std::numbers::pi;
    const Point u = radii.x * axisX, v = radii.y * axisY;
    return CenterArc{0.5 * (from + arc.to) + center.x * u + center.y * v, u, v, start, sweep};
}

Box boundingBox(const Path& path, const Affine& transform) {
    BoxBuilder builder{transform, {}};
    forEachSegment(path, builder);
    return builder.box;
}

double lengthOf(const Path& path) {
    LengthSum length;
    forEachSegment(path, length);
    return length.sum;
}

Path mapPath(const Affine& transform, const Path& path) {
    PathMapper mapper{transform, {}};
    forEachSegment(path, mapper);
    return std::move(mapper.out);
}

bool isDrawable(const Path& path, const Affine& transform) {
    const auto fine = [&](Point p) {
        const Point mapped = scene::apply(transform, p);
        return std::abs(p.x) <= maxCoordinate && std::abs(p.y) <= maxCoordinate &&
               std::abs(mapped.x) <= maxCoordinate && std::abs(mapped.y) <= maxCoordinate;
    };
    return std::all_of(path.begin(), path.end(), [&](const scene::Command& command) {
        if (const auto* move = std::get_if<scene::MoveTo>(&command))
            return fine(move->to);
        if (const auto* line = std::get_if<scene::LineTo>(&command))
            return fine(line->to);
        if (const auto* quad = std::get_if<scene::QuadTo>(&command))
            return fine(quad->control) && fine(quad->to);
        if (const auto* cubic = std::get_if<scene::CubicTo>(&command))
            return fine(cubic->control1) && fine(cubic->control2) && fine(cubic->to);
        if (const auto* arc = std::get_if<scene::ArcTo>(&command))
            return fine(arc->radii) && fine(arc->to) && std::isfinite(arc->rotation);
        return true;
    });
}

}  // namespace vtm::svg
