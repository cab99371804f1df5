#include "compiler/stroke.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "compiler/compile.hpp"

namespace vtm::compiler {
namespace {

using namespace scene;
using std::numbers::pi;

using Polygon = std::vector<Point>;

double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }

/// Chords of any path of lines, quads and cubics, with a fixed and high number of steps a curve.
class Flattener {
public:
    explicit Flattener(int steps) : steps_(steps) {}
    void operator()(const MoveTo& c) { polygons.push_back({c.to}); }
    void operator()(const LineTo& c) { polygons.back().push_back(c.to); }
    void operator()(const QuadTo& c) {
        const Point a = polygons.back().back();
        (*this)(CubicTo{a + (c.control - a) * (2.0 / 3), c.to + (c.control - c.to) * (2.0 / 3), c.to});
    }
    void operator()(const CubicTo& c) {
        const Point a = polygons.back().back();
        for (int i = 1; i <= steps_; ++i) {
            const double t = double(i) / steps_, s = 1 - t;
            polygons.back().push_back(a * (s * s * s) + c.control1 * (3 * s * s * t) +
                                      c.control2 * (3 * s * t * t) + c.to * (t * t * t));
        }
    }
    void operator()(const ArcTo&) { FAIL() << "an arc in an outline"; }
    void operator()(const Close&) { polygons.back().push_back(polygons.back().front()); }
    std::vector<Polygon> polygons;

private:
    int steps_;
};

std::vector<Polygon> flatten(const Path& path, int steps) {
    Flattener flattener(steps);
    for (const Command& c : path)
        std::visit(flattener, c);
    return flattener.polygons;
}

int winding(const std::vector<Polygon>& polygons, Point p) {
    int result = 0;
    for (const Polygon& polygon : polygons)
        for (std::size_t i = 0; i + 1 < polygon.size(); ++i) {
            const Point a = polygon[i], b = polygon[i + 1];
            if ((a.y <= p.y) == (b.y <= p.y))
                continue;
            const double side = cross(b - a, p - a);
            if (b.y > a.y && side > 0)
                ++result;
            else if (b.y <= a.y && side < 0)
                --result;
        }
    return result;
}

double distanceToChord(Point a, Point b, Point p) {
    const double square = glm::dot(b - a, b - a);
    const double t = square > 0 ? std::clamp(glm::dot(p - a, b - a) / square, 0.0, 1.0) : 0;
    return glm::distance(p, a + (b - a) * t);
}

double distanceTo(const std::vector<Polygon>& polygons, Point p) {
    double best = std::numeric_limits<double>::infinity();
    for (const Polygon& polygon : polygons)
        for (std::size_t i = 0; i + 1 < polygon.size(); ++i)
            best = std::min(best, distanceToChord(polygon[i], polygon[i + 1], p));
    return best;
}

/// Green's theorem; overlaps count twice.
double area(const Path& path) {
    double sum = 0;
    for (const Polygon& polygon : flatten(path, 2000))
        for (std::size_t i = 0; i + 1 < polygon.size(); ++i)
            sum += cross(polygon[i], polygon[i + 1]) / 2;
    return sum;
}

std::size_t edges(const Path& path) {
    return std::size_t(std::count_if(path.begin(), path.end(),
                                     [](const Command& c) { return !std::holds_alternative<MoveTo>(c); }));
}

std::size_t contours(const Path& path) {
    return std::size_t(std::count_if(path.begin(), path.end(),
                                     [](const Command& c) { return std::holds_alternative<MoveTo>(c); }));
}

StrokeStyle style(double width, Cap cap = Cap::Butt, Join join = Join::Miter) {
    StrokeStyle s;
    s.width = width;
    s.cap = cap;
    s.join = join;
    return s;
}

bool inside(const Path& outline, Point p) { return winding(flatten(outline, 200), p) != 0; }

Path polyline(std::initializer_list<Point> points, bool closed = false) {
    Path path{MoveTo{*points.begin()}};
    for (const Point* p = points.begin() + 1; p != points.end(); ++p)
        path.push_back(LineTo{*p});
    if (closed)
        path.push_back(Close{});
    return path;
}

Path circle(Point center, double radius) {
    const Point r{radius, radius}, x{radius, 0};
    return {MoveTo{center + x}, ArcTo{r, 0, false, true, center - x}, ArcTo{r, 0, false, true, center + x},
            Close{}};
}

// --- the stroke is the set of points near the path ----------------------------------------------------

/// Random points, half of them close to the boundary, must be inside or outside as their distance to the
/// path says, unless they are within the tolerance of the boundary.
void expectNeighbourhood(const Path& path, double width, double tolerance, unsigned seed, int samples = 300) {
    const Path outline = strokeOutline(path, style(width, Cap::Round, Join::Round), tolerance);
    const auto spine = flatten(path, 3000), border = flatten(outline, 64);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0, 1), angle(0, 2 * pi);
    const double flattening = 1e-6 * (width + 100);
    for (int i = 0; i < samples; ++i) {
        const Polygon& polygon = spine[std::size_t(share(random) * double(spine.size()))];
        const Point on = polygon[std::size_t(share(random) * double(polygon.size()))];
        const double reach =
            i % 2 ? share(random) * width : width / 2 + (share(random) - 0.5) * 20 * tolerance;
        const double a = angle(random);
        const Point p = on + Point{std::cos(a), std::sin(a)} * reach;
        const double d = distanceTo(spine, p);
        if (std::abs(d - width / 2) <= tolerance + flattening)
            continue;
        const int w = winding(border, p);
        ASSERT_GE(w, 0) << "seed " << seed << " width " << width << " at " << p.x << "," << p.y;
        ASSERT_EQ(w != 0, d < width / 2) << "seed " << seed << " width " << width << " tolerance "
                                         << tolerance << " distance " << d << " at " << p.x << "," << p.y;
    }
}

Point randomPoint(std::mt19937& random) {
    std::uniform_real_distribution<double> d(0, 100);
    return {d(random), d(random)};
}

struct Case {
    double width, tolerance;
};

class Neighbourhood : public testing::TestWithParam<Case> {};

TEST_P(Neighbourhood, RandomCubics) {
    for (unsigned seed = 0; seed < 60; ++seed) {
        std::mt19937 random(seed);
        const Point a = randomPoint(random), b = randomPoint(random), c = randomPoint(random),
                    d = randomPoint(random);
        expectNeighbourhood({MoveTo{a}, CubicTo{b, c, d}}, GetParam().width, GetParam().tolerance, seed);
    }
}

TEST_P(Neighbourhood, RandomQuads) {
    for (unsigned seed = 0; seed < 40; ++seed) {
        std::mt19937 random(seed);
        const Point a = randomPoint(random), b = randomPoint(random), c = randomPoint(random);
        expectNeighbourhood({MoveTo{a}, QuadTo{b, c}}, GetParam().width, GetParam().tolerance, seed);
    }
}

TEST_P(Neighbourhood, RandomClosedMixtures) {
    for (unsigned seed = 0; seed < 25; ++seed) {
        std::mt19937 random(seed);
        Path path{MoveTo{randomPoint(random)}};
        for (int i = 0; i < 3; ++i) {
            path.push_back(LineTo{randomPoint(random)});
            const Point b = randomPoint(random), c = randomPoint(random), d = randomPoint(random);
            path.push_back(CubicTo{b, c, d});
        }
        if (seed % 2)
            path.push_back(Close{});
        expectNeighbourhood(path, GetParam().width, GetParam().tolerance, seed);
    }
}

TEST_P(Neighbourhood, RandomPolygons) {
    for (unsigned seed = 0; seed < 25; ++seed) {
        std::mt19937 random(seed);
        Path path{MoveTo{randomPoint(random)}};
        for (unsigned i = 0; i < 2 + seed % 12; ++i)
            path.push_back(LineTo{randomPoint(random)});
        if (seed % 3)
            path.push_back(Close{});
        expectNeighbourhood(path, GetParam().width, GetParam().tolerance, seed);
    }
}

TEST_P(Neighbourhood, CuspsLoopsAndHairpins) {
    const Point o{0, 0};
    const std::vector<Path> paths{
        {MoveTo{o}, CubicTo{{100, 100}, {0, 100}, {100, 0}}},          // a cusp in the middle
        {MoveTo{o}, CubicTo{{100, 100.001}, {0, 100.001}, {100, 0}}},  // a tiny loop
        {MoveTo{o}, CubicTo{{100, 99.999}, {0, 99.999}, {100, 0}}},    // nearly a cusp
        {MoveTo{o}, CubicTo{{150, 100}, {-50, 100}, {100, 0}}},        // a loop
        {MoveTo{o}, CubicTo{{150, 0}, {-50, 0}, {100, 0}}},            // back and forth on a line
        {MoveTo{o}, CubicTo{{150, 1e-7}, {-50, 0}, {100, 0}}},         // nearly so
        {MoveTo{o}, QuadTo{{100, 0.01}, {0, 0.02}}},                   // a hairpin
        {MoveTo{o}, QuadTo{{100, 0}, {0, 0}}},                         // and back
        {MoveTo{o}, CubicTo{o, {50, 80}, {100, 0}}},                   // no speed at the start
        {MoveTo{o}, CubicTo{{50, 80}, {100, 0}, {100, 0}}},            // none at the end
        {MoveTo{o}, CubicTo{o, {100, 0}, {100, 0}}},                   // at neither
        {MoveTo{o}, CubicTo{{1e-6, 1e-6}, {50, 80}, {100, 0}}},        // nearly none
        {MoveTo{o}, CubicTo{{100, 0}, {0, 0}, {0, 100}}},
        {MoveTo{o}, CubicTo{{100, 0}, o, o}},
    };
    for (std::size_t i = 0; i < paths.size(); ++i) {
        SCOPED_TRACE("path " + std::to_string(i));
        expectNeighbourhood(paths[i], GetParam().width, GetParam().tolerance, unsigned(i), 1000);
    }
}

INSTANTIATE_TEST_SUITE_P(Stroke, Neighbourhood,
                         testing::Values(Case{0.01, 1e-3}, Case{1, 1e-5}, Case{5, 1e-2}, Case{20, 1e-4},
                                         Case{20, 1e-1}, Case{60, 1e-3}, Case{200, 1e-2}, Case{1000, 1e-1},
                                         Case{1000, 1e-4}));

}  // namespace
}  // namespace vtm::compiler
