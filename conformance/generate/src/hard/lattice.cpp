#include <glm/common.hpp>

#include "conformance/generate/src/hard/families.hpp"

namespace vtm::generate {

using namespace scene;

namespace {

/// The compiler's lattice at its default tolerance of 2^-16: 64 steps a tolerance, in the picture's side.
constexpr double step = 1.0 / (1 << 22);

/// On a line of the tree at a random level; borders of cells of the level, or with `odd` those that only it
/// has.
double dyadic(Sketch& s, bool odd = false) {
    const int level = s.random.integer(1, 7), count = 1 << level;
    const int k = odd ? 2 * s.random.integer(0, count / 2 - 1) + 1 : s.random.integer(0, count);
    return s.side() * k / count;
}
/// Nothing, or up to a few steps of the lattice, or half ones.
double hair(Sketch& s) { return s.random.chance(0.4) ? 0 : 0.5 * s.random.integer(-5, 5) * step * s.side(); }
Point onBorders(Sketch& s) {
    const double x = dyadic(s) + hair(s);
    return {x, dyadic(s) + hair(s)};
}
Point onCorner(Sketch& s) {
    const double x = dyadic(s, true);
    return {x, dyadic(s, true)};
}

void stroke(Sketch& s, const StrokeStyle& style) {
    s.add({MoveTo{s.point()}, CubicTo{s.point(), s.point(), s.point()}, LineTo{s.point()}}, style);
}

}  // namespace

Scene cellBorders(std::uint64_t seed) {
    Sketch s(seed);
    for (int i = s.random.integer(2, 20); i > 0; --i) {
        const Point a = onBorders(s);
        s.fillAny(rectangle(a, onBorders(s)));
    }
    return s.scene;
}

Scene cellCorners(std::uint64_t seed) {
    Sketch s(seed);
    for (int i = s.random.integer(2, 12); i > 0; --i) {
        std::vector<Point> points;
        for (int k = s.random.integer(3, 6); k > 0; --k)
            points.push_back(s.random.chance(0.3) && !points.empty()
                                 ? points.back() + Point(s.random.uniform(-1, 1) * s.side())
                                 : onCorner(s));
        s.fillAny(polygon(points));
    }
    return s.scene;
}

Scene borderRuns(std::uint64_t seed) {
    Sketch s(seed);
    for (int i = s.random.integer(1, 5); i > 0; --i) {
        const double line = dyadic(s), height = s.random.magnitude(0.25, 1e4) * step * s.side();
        const bool upright = s.random.chance(0.5);
        std::vector<Point> points;
        const int count = s.random.integer(2, 60);
        for (int k = 0; k <= count; ++k)
            points.push_back({s.side() * k / count, line + s.random.uniform(-height, height)});
        points.push_back({s.side(), s.random.uniform(0, s.side())});
        points.push_back({0, s.random.uniform(0, s.side())});
        Item& item = s.fillAny(polygon(points));
        if (upright)
            item.transform = {0, 1, 1, 0, 0, 0};
    }
    return s.scene;
}

Scene borderCurves(std::uint64_t seed) {
    Sketch s(seed);
    for (int i = s.random.integer(1, 6); i > 0; --i) {
        const Point middle = onBorders(s), reach = s.random.point(-0.5, 0.5) * s.side(),
                    bend = s.random.point(-0.5, 0.5) * s.side();
        // The cubic is symmetric about its inflection, the quadratic flat at its extremum.
        const Path paths[] = {
            {MoveTo{middle - reach}, CubicTo{middle - bend, middle + bend, middle + reach}, Close{}},
            {MoveTo{middle - reach},
             QuadTo{{middle.x, middle.y + reach.y}, {middle.x + reach.x, middle.y - reach.y}}},
            circle(middle, glm::abs(reach) + Point(step)),
            {MoveTo{middle}, QuadTo{middle + bend, onBorders(s)}, LineTo{onBorders(s)}}};
        const Path& path = paths[s.random.integer(0, 3)];
        if (s.random.chance(0.7))
            s.fillAny(path);
        else
            s.add(path, s.random.chance(0.5) ? s.style(1.0 / 64, 1.0 / 64) : s.style(1e-4, 0.1));
    }
    return s.scene;
}

Scene latticeSteps(std::uint64_t seed) {
    Sketch s(seed);
    const Point middle = s.random.chance(0.5) ? onCorner(s) : s.inside();
    const double size = s.random.magnitude(1, 3e5) * step * s.side();
    for (int i = s.random.integer(3, 60); i > 0; --i) {
        std::vector<Point> points;
        for (int k = s.random.integer(3, 5); k > 0; --k)
            points.push_back(middle + s.random.point(-size, size));
        s.fillAny(polygon(points));
    }
    return s.scene;
}

Scene longPictures(std::uint64_t seed) {
    Random random(~seed);
    const double ratio = random.magnitude(2, 1e5), base = random.magnitude(0.01, 100);
    const bool wide = random.chance(0.7);
    Sketch s(seed, wide ? base * ratio : base, wide ? base : base * ratio);
    for (int i = s.random.integer(2, 12); i > 0; --i) {
        if (s.random.chance(0.3))
            s.fill(s.anyCircle());
        else if (s.random.chance(0.5))
            s.fill(polygon({s.point(), s.point(), s.point()}));
        else
            stroke(s, s.style(0.01, 1, base));
    }
    return s.scene;
}

Scene scaledPictures(std::uint64_t seed) {
    Random random(~seed);
    const double side = random.magnitude(1e-9, 1e9);
    Sketch s(seed, side, side * random.uniform(0.5, 2));
    for (int i = s.random.integer(2, 10); i > 0; --i) {
        if (s.random.chance(0.3))
            s.fill(s.anyCircle());
        else if (s.random.chance(0.3))
            s.fill(polygon({s.point(), s.point(), s.point()}));
        else {
            StrokeStyle style = s.style(1e-3, 0.3);
            if (s.random.chance(0.5))
                style.dashes = {0.1 * s.side(), 0.07 * s.side()};
            stroke(s, style);
        }
    }
    return s.scene;
}

Scene farArcs(std::uint64_t seed) {
    Sketch s(seed);
    for (int i = s.random.integer(1, 8); i > 0; --i) {
        const double radius = s.random.magnitude(1, 1e7) * s.side();
        const Point through = s.inside();
        const Point centre = polar(through, radius, s.random.uniform(0, 2 * pi));
        const Point from = polar(through, 2 * s.side(), s.random.uniform(0, 2 * pi));
        const bool sweep = s.random.chance(0.5);
        const Path arc{MoveTo{from}, ArcTo{{radius, radius}, 0, false, sweep, 2.0 * through - from}};
        const Path path = s.random.chance(0.5) ? circle(centre, {radius, radius}) : arc;
        if (s.random.chance(0.5))
            s.fillAny(path);
        else
            s.add(path, s.style(1e-3, 0.1));
    }
    return s.scene;
}

}  // namespace vtm::generate
