#include "conformance/reference/outline/flatten.hpp"

#include <limits>
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

namespace {

/// Halvings after which a piece is taken as straight, whatever it is: reached at cusps only, where the
/// direction turns at a point.
constexpr int maxDepth = 48;
/// Doubles cannot tell a curve from its chord below this share of its coordinates.
constexpr double relativePrecision = 1e-13;
/// A piece this small (pixels) is a point: its turn no longer matters.
constexpr double pointSize = 1e-9;

Vector unit(Vector v) {
    const double l = length(v);
    return l > 0 && std::isfinite(l) ? v / l : Vector(0);
}

struct CubicPiece {
    std::array<Point, 4> p;

    Point end() const { return p[3]; }
    Vector startDirection() const {
        for (const int i : {1, 2, 3})
            if (p[i] != p[0])
                return unit(p[i] - p[0]);
        return Vector(0);
    }
    Vector endDirection() const {
        for (const int i : {2, 1, 0})
            if (p[i] != p[3])
                return unit(p[3] - p[i]);
        return Vector(0);
    }
    /// |curve - chord| <= max|B''| / 8, and |B''| <= 6·max|second differences|.
    double deviation(const Affine& m) const {
        const Vector d1 = scene::applyVector(m, p[0] - 2.0 * p[1] + p[2]);
        const Vector d2 = scene::applyVector(m, p[1] - 2.0 * p[2] + p[3]);
        return 0.75 * std::max(length(d1), length(d2));
    }
    /// The control polygon turns at least as much as the curve.
    double turn() const {
        Vector last = startDirection();
        double sum = 0;
        for (int i = 0; i < 3; ++i) {
            if (p[i] == p[i + 1])
                continue;
            const Vector leg = p[i + 1] - p[i];
            sum += angleBetween(last, leg);
            last = leg;
        }
        return sum;
    }
    Box bounds(const Affine& m) const {
        return Box::around(std::array{scene::apply(m, p[0]), scene::apply(m, p[1]), scene::apply(m, p[2]),
                                      scene::apply(m, p[3])});
    }
    std::pair<CubicPiece, CubicPiece> halves() const {  // de Casteljau at 1/2
        const Point a = (p[0] + p[1]) / 2.0, b = (p[1] + p[2]) / 2.0, c = (p[2] + p[3]) / 2.0;
        const Point ab = (a + b) / 2.0, bc = (b + c) / 2.0, middle = (ab + bc) / 2.0;
        return {{{p[0], a, ab, middle}}, {{middle, bc, c, p[3]}}};
    }
};

struct ArcPiece {
    Arc arc;

    Point at(double angle) const {
        return arc.center + std::cos(angle) * arc.axisX + std::sin(angle) * arc.axisY;
    }
    Vector direction(double angle) const {
        const double sign = arc.end < arc.begin ? -1 : 1;
        return unit(sign * (std::cos(angle) * arc.axisY - std::sin(angle) * arc.axisX));
    }
    double middle() const { return (arc.begin + arc.end) / 2; }

    Point end() const { return arc.to; }
    Vector startDirection() const { return direction(arc.begin); }
    Vector endDirection() const { return direction(arc.end); }
    /// Second derivative by the angle: at most the longer half axis of the mapped ellipse.
    double deviation(const Affine& m) const {
        const Affine ellipse{scene::applyVector(m, arc.axisX), scene::applyVector(m, arc.axisY), Vector(0)};
        const double span = arc.end - arc.begin;
        return largestScale(ellipse) * span * span / 8;
    }
    double turn() const {
        const Vector half = direction(middle());
        return angleBetween(startDirection(), half) + angleBetween(half, endDirection());
    }
    /// About the chord, which the curve leaves by the deviation at most.
    Box bounds(const Affine& m) const {
        return Box::around(std::array{scene::apply(m, arc.from), scene::apply(m, arc.to)})
            .grownBy(deviation(m));
    }
    std::pair<ArcPiece, ArcPiece> halves() const {
        Arc first = arc, second = arc;
        first.end = second.begin = middle();
        first.to = second.from = at(middle());
        return {{first}, {second}};
    }
};

/// Comparisons are written so that what is not a number counts as flat: hostile input ends here.
template <class Piece>
bool isFlat(const Piece& piece, const Fineness& f) {
    const double deviation = piece.deviation(f.toPixels);
    const Box box = piece.bounds(f.toPixels);
    if (!box.meets(f.view))
        return !(deviation > std::max(f.tolerance, f.hiddenTolerance * box.size()));
    return !(deviation > f.tolerance) && (!(piece.turn() > f.maxTurn) || box.size() < pointSize);
}

template <class Piece>
void subdivide(const Piece& piece, const Fineness& f, int depth, std::vector<Sample>& out) {
    if (depth == maxDepth || isFlat(piece, f)) {
        out.push_back({piece.end(), piece.endDirection()});
        return;
    }
    const auto [first, second] = piece.halves();
    subdivide(first, f, depth + 1, out);
    subdivide(second, f, depth + 1, out);
}

template <class Piece>
std::vector<Sample> flattenPiece(Point start, const Piece& piece, Fineness f) {
    const Box box = piece.bounds(f.toPixels);
    const double reach =
        std::max({std::abs(box.min.x), std::abs(box.min.y), std::abs(box.max.x), std::abs(box.max.y)});
    f.tolerance = std::max(f.tolerance, relativePrecision * reach);
    std::vector<Sample> samples{{start, piece.startDirection()}};
    subdivide(piece, f, 0, samples);
    return samples;
}

}  // namespace

std::vector<Sample> flatten(const Curve& curve, const Fineness& fineness) {
    if (const auto* line = std::get_if<Line>(&curve)) {
        const Vector direction = unit(line->to - line->from);
        return {{line->from, direction}, {line->to, direction}};
    }
    if (const auto* cubic = std::get_if<Cubic>(&curve))
        return flattenPiece(cubic->p[0], CubicPiece{cubic->p}, fineness);
    const Arc& arc = std::get<Arc>(curve);
    return flattenPiece(arc.from, ArcPiece{arc}, fineness);
}

}  // namespace vtm::reference
