#include "conformance/generate/src/outlines.hpp"

#include <numbers>
#include <variant>

namespace vtm::generate {
namespace {

using namespace scene;
using std::numbers::pi;

constexpr double outside = 0.15;  ///< how far points reach over the picture's border, as a share of its side

class Outlines {
public:
    Outlines(Random& random, double side, const Path& before)
        : random_(random), side_(side), before_(before) {}

    Path any() {
        switch (random_.integer(0, 15)) {
            case 0:
                return polygon();
            case 1:
                return gridPolygon();
            case 2:
                return gridRectangles();
            case 3:
                return rays();
            case 4:
                return wedges();
            case 5:
                return cubics();
            case 6:
                return quadratics();
            case 7:
                return arcs();
            case 8:
                return cusp();
            case 9:
                return thread();
            case 10:
                return tangentCircles();
            case 11:
                return stutter();
            case 12:
                return doubledBack();
            case 13:
                return nearCopy();
            case 14:
                return farAway();
            default:
                return exactCopy();
        }
    }

private:
    Point point() { return random_.point(-outside * side_, (1 + outside) * side_); }
    /// On a grid whose lines are borders of cells, so that edges coincide there.
    Point gridPoint() {
        const double step = side_ / 16;
        return {step * random_.integer(-1, 17), step * random_.integer(-1, 17)};
    }
    static Point polar(Point centre, double radius, double angle) {
        return centre + radius * Point(std::cos(angle), std::sin(angle));
    }
    /// Not always closed: fills do it themselves, strokes get caps.
    Path ended(Path path) {
        if (random_.chance(0.7))
            path.push_back(Close{});
        return path;
    }

    Path polygon() {
        Path path{MoveTo{point()}};
        for (int i = random_.integer(1, 8); i >= 0; --i)
            path.push_back(LineTo{point()});
        return ended(path);
    }

    Path gridPolygon() {
        Path path{MoveTo{gridPoint()}};
        for (int i = random_.integer(1, 8); i >= 0; --i)
            path.push_back(LineTo{gridPoint()});
        return ended(path);
    }

    Path gridRectangles() {
        Path path;
        for (int i = random_.integer(1, 4); i > 0; --i) {
            const Path one = rectangle(gridPoint(), gridPoint());
            path.insert(path.end(), one.begin(), one.end());
        }
        return path;
    }

    /// A star: every other point is the hub, or near it.
    Path rays() {
        const Point hub = point();
        const double near = random_.chance(0.5) ? 0 : random_.magnitude(1e-6, 1e-2) * side_;
        const double radius = random_.uniform(0.1, 0.6) * side_;
        const int count = random_.integer(3, 40);
        Path path{MoveTo{hub}};
        for (int i = 0; i < count; ++i) {
            const double angle = 2 * pi * (i + random_.uniform(0, 0.9)) / count;
            path.push_back(LineTo{polar(hub, radius, angle)});
            path.push_back(LineTo{polar(hub, near, random_.uniform(0, 2 * pi))});
        }
        return ended(path);
    }

    /// Triangles that share one vertex, abut or overlap.
    Path wedges() {
        const Point hub = random_.chance(0.5) ? gridPoint() : point();
        const double radius = random_.uniform(0.1, 0.5) * side_;
        const int count = random_.integer(3, 30);
        Path path;
        for (int i = 0; i < count; ++i) {
            const double from = 2 * pi * i / count, to = from + 2 * pi / count * random_.integer(1, 2);
            path.push_back(MoveTo{hub});
            path.push_back(LineTo{polar(hub, radius, from)});
            path.push_back(LineTo{polar(hub, radius, to)});
            path.push_back(Close{});
        }
        return path;
    }

    Path cubics() {
        Path path{MoveTo{point()}};
        for (int i = random_.integer(0, 3); i >= 0; --i)
            path.push_back(CubicTo{point(), point(), point()});
        return ended(path);
    }

    Path quadratics() {
        Path path{MoveTo{point()}};
        for (int i = random_.integer(0, 4); i >= 0; --i)
            path.push_back(QuadTo{point(), point()});
        return ended(path);
    }

    Path arcs() {
        Path path{MoveTo{point()}};
        for (int i = random_.integer(0, 3); i >= 0; --i)
            path.push_back(ArcTo{{random_.magnitude(1e-3, 1) * side_, random_.magnitude(1e-3, 1) * side_},
                                 random_.uniform(0, pi),
                                 random_.chance(0.5),
                                 random_.chance(0.5),
                                 point()});
        return ended(path);
    }

    /// Control points crossed just so (a cusp), or by more or less (a loop, a bend).
    Path cusp() {
        const Point a = point(), d = point(), along = d - a, across{-along.y, along.x};
        const double over = random_.chance(0.5) ? 1 : random_.uniform(0.9, 1.5);
        const double height = random_.uniform(0.2, 1);
        return ended(
            {MoveTo{a}, CubicTo{a + over * along + height * across, d - over * along + height * across, d}});
    }

    /// Thinner than anything that a lattice keeps apart, or just as thin.
    Path thread() {
        const Point a = point(), b = point();
        const Point across = random_.magnitude(1e-9, 1e-3) * Point{a.y - b.y, b.x - a.x};
        if (random_.chance(0.5))
            return {MoveTo{a}, LineTo{b}, LineTo{b + across}, LineTo{a + across}, Close{}};
        const Point middle = (a + b) * 0.5 + 0.2 * Point{a.y - b.y, b.x - a.x};
        return {MoveTo{a}, QuadTo{middle, b}, LineTo{b + across}, QuadTo{middle + across, a + across},
                Close{}};
    }

    static void addCircle(Path& path, Point centre, double radius) {
        path.push_back(MoveTo{centre - Point{radius, 0}});
        path.push_back(ArcTo{{radius, radius}, 0, false, true, centre + Point{radius, 0}});
        path.push_back(ArcTo{{radius, radius}, 0, false, true, centre - Point{radius, 0}});
        path.push_back(Close{});
    }

    /// Circles that touch from inside or outside, and a box round one of them.
    Path tangentCircles() {
        const Point centre = random_.point(0.2 * side_, 0.8 * side_);
        const double radius = random_.uniform(0.05, 0.3) * side_, other = random_.uniform(0.05, 0.3) * side_;
        const double angle = random_.chance(0.5) ? 0 : random_.uniform(0, 2 * pi);
        const double distance = random_.chance(0.5) ? radius + other : std::abs(radius - other);
        Path path;
        addCircle(path, centre, radius);
        addCircle(path, polar(centre, distance, angle), other);
        const Path box = rectangle(centre - Point{radius, radius}, centre + Point{radius, radius});
        path.insert(path.end(), box.begin(), box.end());
        return path;
    }

    /// Segments of no length, subpaths of one point, doubled commands.
    Path stutter() {
        const Point a = point(), b = point(), c = point();
        return ended({MoveTo{c}, MoveTo{a}, LineTo{a}, LineTo{b}, LineTo{b}, CubicTo{b, b, b}, QuadTo{c, c},
                      QuadTo{c, c}, ArcTo{{1, 1}, 0, true, true, c}, LineTo{point()}, LineTo{point()}});
    }

    /// Runs back over itself: the same line twice, a flat cubic.
    Path doubledBack() {
        const Point a = point(), b = point(), between = a + random_.uniform(-0.5, 1.5) * (b - a);
        if (random_.chance(0.5))
            return ended({MoveTo{a}, LineTo{b}, LineTo{between}, LineTo{point()}});
        return ended({MoveTo{a}, CubicTo{a + 2.0 * (b - a), a - (b - a), between}, LineTo{point()}});
    }

    /// The path before, each point moved by a hair.
    Path nearCopy() {
        const double hair = random_.magnitude(1e-10, 1e-3) * side_;
        const auto moved = [&](Point p) { return p + random_.point(-hair, hair); };
        Path path = exactCopy();
        for (Command& command : path) {
            if (auto* m = std::get_if<MoveTo>(&command))
                m->to = moved(m->to);
            else if (auto* l = std::get_if<LineTo>(&command))
                l->to = moved(l->to);
            else if (auto* q = std::get_if<QuadTo>(&command))
                *q = {moved(q->control), moved(q->to)};
            else if (auto* c = std::get_if<CubicTo>(&command))
                *c = {moved(c->control1), moved(c->control2), moved(c->to)};
            else if (auto* a = std::get_if<ArcTo>(&command))
                a->to = moved(a->to);
        }
        return path;
    }

    Path exactCopy() { return before_.empty() ? polygon() : before_; }

    /// Mostly out of the picture.
    Path farAway() {
        const double reach = random_.magnitude(10, 1e7) * side_;
        Path path{MoveTo{point()}};
        for (int i = random_.integer(1, 3); i >= 0; --i) {
            if (random_.chance(0.5))
                path.push_back(LineTo{random_.point(-reach, reach)});
            else
                path.push_back(CubicTo{random_.point(-reach, reach), point(), random_.point(-reach, reach)});
        }
        return ended(path);
    }

    Random& random_;
    const double side_;
    const Path& before_;
};

}  // namespace

scene::Path randomOutline(Random& random, double side, const scene::Path& before) {
    return Outlines(random, side, before).any();
}

}  // namespace vtm::generate
