#include "conformance/generate/src/hard/families.hpp"

namespace vtm::generate {

using namespace scene;

namespace {

Path sliver(Sketch& s) {
    const Point a = s.point(), b = s.point(), thin = s.random.magnitude(1e-8, 0.02) * across(b - a);
    if (s.random.chance(0.4))
        return polygon({a, b, b + thin});
    if (s.random.chance(0.5))
        return polygon({a, b, b + thin, a + thin});
    const Point bend = (a + b) * 0.5 + s.random.uniform(-0.3, 0.3) * across(b - a);
    return {MoveTo{a}, QuadTo{bend, b}, LineTo{b + thin}, QuadTo{bend + thin, a + thin}, Close{}};
}

/// Through a point, each of its edges turned by a random angle.
Path blob(Sketch& s, int corners) {
    const Point centre = s.inside();
    Path path;
    for (int i = 0; i < corners; ++i) {
        const auto at = [&](double k) {
            return polar(centre, s.random.uniform(0.1, 0.5) * s.side(), 2 * pi * k / corners);
        };
        if (i == 0)
            path.push_back(MoveTo{at(0)});
        else if (s.random.chance(0.5))
            path.push_back(LineTo{at(i)});
        else
            path.push_back(QuadTo{at(i - 0.5), at(i)});
    }
    path.push_back(Close{});
    return path;
}

/// Every point moved by up to `hair`.
Path moved(Path path, double hair, Random& random) {
    const auto nudge = [&](Point& p) { p += random.point(-hair, hair); };
    for (Command& command : path)
        std::visit(
            [&](auto& c) {
                if constexpr (requires { c.control; })
                    nudge(c.control);
                if constexpr (requires { c.to; })
                    nudge(c.to);
            },
            command);
    return path;
}

Path backwards(const std::vector<Point>& points) { return polygon({points.rbegin(), points.rend()}); }

}  // namespace

Scene slivers(std::uint64_t seed) {
    Sketch s(seed);
    for (int i = s.random.integer(5, 40); i > 0; --i)
        s.fill(sliver(s));
    return s.scene;
}

Scene fans(std::uint64_t seed) {
    Sketch s(seed);
    for (int fan = s.random.integer(1, 2); fan > 0; --fan) {
        const Point hub = s.random.chance(0.5) ? s.size() * 0.5 : s.inside();
        const int count = s.random.integer(5, 60);
        const double wide = s.random.chance(0.5) ? 1 : s.random.uniform(0.3, 3);
        const double length = s.random.uniform(0.2, 0.8) * s.side();
        for (int i = 0; i < count; ++i) {
            const double from = 2 * pi * i / count, to = from + wide * 2 * pi / count;
            s.fill(polygon({hub, polar(hub, length, from), polar(hub, length, to)}));
        }
    }
    return s.scene;
}

Scene nearlyCoincident(std::uint64_t seed) {
    Sketch s(seed);
    const Path path = blob(s, s.random.integer(3, 9));
    const double hair = s.random.magnitude(1e-9, 3e-3) * s.side();
    for (int i = s.random.integer(2, 12); i > 0; --i)
        s.fillAny(moved(path, hair, s.random));
    return s.scene;
}

Scene cusps(std::uint64_t seed) {
    Sketch s(seed);
    for (int i = s.random.integer(1, 6); i > 0; --i) {
        const Point a = s.point(), d = s.point(), along = d - a;
        const double sign = s.random.chance(0.5) ? 1 : -1;
        const double off = s.random.chance(0.3) ? 0 : sign * s.random.magnitude(1e-8, 0.5);
        const Point up = s.random.uniform(0.2, 1) * across(along), over = (1 + off) * along;
        Path path{MoveTo{a}, CubicTo{a + over + up, d - over + up, d}};
        if (s.random.chance(0.5))
            s.fillAny(std::move(path));
        else
            s.add(std::move(path), s.style(1e-3, 0.2));
    }
    return s.scene;
}

Scene concentric(std::uint64_t seed) {
    Sketch s(seed);
    const Point centre = s.inside(0.4);
    const int count = s.random.integer(3, 40), corners = s.random.integer(2, 12);
    const double flat = s.random.chance(0.5) ? 1 : s.random.uniform(0.1, 1);
    Path rings;
    for (int i = count; i > 0; --i) {
        const double radius = 0.6 * s.side() * i / count;
        std::vector<Point> points;
        for (int k = 0; k < corners; ++k)
            points.push_back(polar(centre, radius, 2 * pi * k / corners));
        append(rings, corners == 2 ? circle(centre, {radius, flat * radius})
                      : i % 2 == 0 ? backwards(points)
                                   : polygon(points));
    }
    if (s.random.chance(0.5))
        s.add(std::move(rings), FillRule::EvenOdd);
    else
        for (int i = 0; i < count; ++i) {
            const double radius = 0.6 * s.side() * (count - i) / count;
            s.fill(circle(centre, {radius, flat * radius}));
        }
    return s.scene;
}

Scene selfOverlaps(std::uint64_t seed) {
    Sketch s(seed);
    for (int i = s.random.integer(1, 4); i > 0; --i) {
        const int corners = s.random.integer(5, 31), step = s.random.integer(2, corners / 2);
        const Point centre = s.inside();
        std::vector<Point> points;
        for (int k = 0; k < corners; ++k)
            points.push_back(s.random.chance(0.2)
                                 ? s.point()
                                 : polar(centre, 0.5 * s.side(), 2 * pi * k * step / corners));
        Path path = polygon(points);
        if (s.random.chance(0.3))
            append(path, polygon(points));
        if (s.random.chance(0.2))
            append(path, backwards(points));
        s.fillAny(std::move(path));
    }
    return s.scene;
}

Scene huge(std::uint64_t seed) {
    Sketch s(seed);
    for (int i = s.random.integer(2, 8); i > 0; --i) {
        const double reach = s.random.magnitude(1e2, 1e7) * s.side();
        const auto far = [&] { return s.random.chance(0.3) ? s.point() : s.random.point(-reach, reach); };
        Path path{MoveTo{far()}};
        for (int k = s.random.integer(2, 4); k > 0; --k) {
            const Point control = far();
            if (s.random.chance(0.5))
                path.push_back(LineTo{control});
            else if (s.random.chance(0.5))
                path.push_back(QuadTo{control, far()});
            else
                path.push_back(CubicTo{control, far(), far()});
        }
        s.fillAny(std::move(path));
    }
    return s.scene;
}

Scene tiny(std::uint64_t seed) {
    Sketch s(seed);
    const double size = s.random.magnitude(1e-8, 1e-2) * s.side();
    const bool crowd = s.random.chance(0.5);
    const Point middle = s.inside();
    for (int i = s.random.integer(10, 200); i > 0; --i) {
        const Point at = crowd ? middle + s.random.point(-5 * size, 5 * size) : s.inside(0);
        if (s.random.chance(0.5))
            s.fill(circle(at, {size, size}));
        else
            s.fill(polygon({at, at + s.random.point(-size, size), at + s.random.point(-size, size)}));
    }
    return s.scene;
}

Scene hairlineGrids(std::uint64_t seed) {
    Sketch s(seed);
    const double turn = s.random.chance(0.5) ? 0 : s.random.uniform(0, pi);
    const int count = s.random.integer(3, 40);
    for (int i = 0; i < count; ++i) {
        const double at = (i + 0.5) / count * s.side(), thin = s.random.magnitude(1e-6, 0.02) * s.side();
        s.fill(rectangle({-10, at}, {74, at + thin})).transform = about({32, 32}, turn, 1, 1);
        s.fill(rectangle({at, -10}, {at + thin, 74})).transform = about({32, 32}, turn, 1, 1);
    }
    return s.scene;
}

Scene abutting(std::uint64_t seed) {
    Sketch s(seed);
    const int columns = s.random.integer(1, 7), rows = s.random.integer(1, 7);
    const double turn = s.random.chance(0.5) ? 0 : s.random.uniform(0, pi);
    const Affine turned = about({32, 32}, turn, 1, 1);
    const auto at = [&](double x, double y) { return Point(64 * x / columns, 64 * y / rows); };
    for (int x = 0; x < columns; ++x)
        for (int y = 0; y < rows; ++y) {
            std::vector<Point> points{at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)};
            if (s.random.chance(0.3))
                points.insert(points.begin() + 1, at(x + s.random.uniform(0, 1), y));
            if (s.random.chance(0.3))
                points.insert(points.end() - 1, at(x + 1, y + 1 - s.random.uniform(0, 1)));
            const bool back = s.random.chance(0.5);
            s.fill(back ? backwards(points) : polygon(points)).transform = turned;
        }
    return s.scene;
}

}  // namespace vtm::generate
