#include "conformance/reference/outline/flatten.hpp"

#include <limits>

namespace vtm::reference {
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
