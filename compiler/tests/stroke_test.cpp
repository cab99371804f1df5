#include "compiler/stroke.hpp"

#include <algorithm>
#include <array>
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

double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }

using Curve = std::array<Point, 4>;

Point at(const Curve& c, double t) {
    const double s = 1 - t;
    return c[0] * (s * s * s) + c[1] * (3 * s * s * t) + c[2] * (3 * s * t * t) + c[3] * (t * t * t);
}

/// A path of lines, quads and cubics as cubics.
class Curves {
public:
    void operator()(const MoveTo& c) { start_ = at_ = c.to; }
    void operator()(const LineTo& c) { add(at_ + (c.to - at_) / 3.0, c.to + (at_ - c.to) / 3.0, c.to); }
    void operator()(const QuadTo& c) {
        add(at_ + (c.control - at_) * (2.0 / 3), c.to + (c.control - c.to) * (2.0 / 3), c.to);
    }
    void operator()(const CubicTo& c) { add(c.control1, c.control2, c.to); }
    void operator()(const ArcTo&) { FAIL() << "an arc where none may be"; }
    void operator()(const Close&) { (*this)(LineTo{start_}); }
    std::vector<Curve> list;

private:
    void add(Point a, Point b, Point to) {
        list.push_back({at_, a, b, to});
        at_ = to;
    }
    Point start_{0, 0}, at_{0, 0};
};

std::vector<Curve> curves(const Path& path) {
    Curves result;
    for (const Command& c : path)
        std::visit(result, c);
    return result.list;
}

/// Signed crossings with the ray from `p` towards +x.
int crossings(const Curve& c, Point p, int depth = 50) {
    const auto [low, high] = std::minmax({c[0].y, c[1].y, c[2].y, c[3].y});
    const auto [left, right] = std::minmax({c[0].x, c[1].x, c[2].x, c[3].x});
    if (high <= p.y || low > p.y || right <= p.x)
        return 0;
    if (left > p.x || depth == 0)
        return (c[3].y > p.y) - (c[0].y > p.y);
    const Point a = (c[0] + c[1]) / 2.0, b = (c[1] + c[2]) / 2.0, d = (c[2] + c[3]) / 2.0;
    const Point e = (a + b) / 2.0, f = (b + d) / 2.0, m = (e + f) / 2.0;
    return crossings({c[0], a, e, m}, p, depth - 1) + crossings({m, f, d, c[3]}, p, depth - 1);
}

int winding(const std::vector<Curve>& outline, Point p) {
    int result = 0;
    for (const Curve& c : outline)
        result += crossings(c, p);
    return result;
}

/// Ternary search round each local minimum of the samples.
double distanceTo(const Curve& c, Point p) {
    constexpr int steps = 100;
    const auto distance = [&](double t) { return glm::distance(at(c, t), p); };
    std::array<double, steps + 1> coarse{};
    for (int i = 0; i <= steps; ++i)
        coarse[std::size_t(i)] = distance(double(i) / steps);
    double best = std::min(coarse.front(), coarse.back());
    for (int i = 0; i <= steps; ++i) {
        const int before = std::max(i - 1, 0), after = std::min(i + 1, steps);
        if (coarse[std::size_t(i)] > std::min(coarse[std::size_t(before)], coarse[std::size_t(after)]))
            continue;
        double low = double(before) / steps, high = double(after) / steps;
        for (int k = 0; k < 60; ++k) {
            const double third = (high - low) / 3;
            if (distance(low + third) < distance(high - third))
                high -= third;
            else
                low += third;
        }
        best = std::min(best, distance((low + high) / 2));
    }
    return best;
}

double distanceTo(const std::vector<Curve>& spine, Point p) {
    double best = std::numeric_limits<double>::infinity();
    for (const Curve& c : spine)
        best = std::min(best, distanceTo(c, p));
    return best;
}

/// Green's theorem, exact for cubics; overlaps count twice.
double area(const Path& path) {
    double sum = 0;
    for (const Curve& c : curves(path))
        sum += 3.0 / 20 *
                   (cross(c[0], c[1]) * 2 + cross(c[0], c[2]) + cross(c[1], c[2]) + cross(c[1], c[3]) +
                    2 * cross(c[2], c[3])) +
               cross(c[0], c[3]) / 20;
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

bool inside(const Path& outline, Point p) { return winding(curves(outline), p) != 0; }

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
    const auto spine = curves(path), border = curves(outline);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0, 1), angle(0, 2 * pi);
    const double rounding = 1e-9 * (width + 100);
    for (int i = 0; i < samples; ++i) {
        const Point on = at(spine[std::size_t(share(random) * double(spine.size()))], share(random));
        const double reach =
            i % 2 ? share(random) * width : width / 2 + (share(random) - 0.5) * 20 * tolerance;
        const double a = angle(random);
        const Point p = on + Point{std::cos(a), std::sin(a)} * reach;
        const double d = distanceTo(spine, p);
        if (std::abs(d - width / 2) <= tolerance + rounding)
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
