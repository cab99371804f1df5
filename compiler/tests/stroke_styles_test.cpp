// Every cap and join on every kind of curve, against the stroke's definition: the union of what the normal
// sweeps, of joins and of caps, each as small polygons.

#include <random>
#include <string>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "compiler/tests/stroke_support.hpp"

namespace vtm::compiler {
namespace {

Point perp(Point v) { return {-v.y, v.x}; }

/// A command and the same curve as points with unit tangents.
struct Piece {
    Command command;
    std::vector<std::pair<Point, Point>> spine;
};

constexpr int steps = 300;

Piece cubic(const Curve& c) {
    Piece p{CubicTo{c[1], c[2], c[3]}, {}};
    for (int i = 0; i <= steps; ++i) {
        // Tangents not at an end itself, where coincident controls leave no speed.
        const double t = std::clamp(double(i) / steps, 1e-7, 1 - 1e-7), s = 1 - t;
        const Point d = (c[1] - c[0]) * (s * s) + (c[2] - c[1]) * (2 * s * t) + (c[3] - c[2]) * (t * t);
        p.spine.emplace_back(at(c, double(i) / steps), glm::normalize(d));
    }
    return p;
}

Piece line(Point a, Point b) {
    Piece p = cubic({a, a + (b - a) / 3.0, b + (a - b) / 3.0, b});
    p.command = LineTo{b};
    return p;
}

Piece quad(Point a, Point q, Point b) {
    Piece p = cubic({a, a + (q - a) * (2.0 / 3), b + (q - b) * (2.0 / 3), b});
    p.command = QuadTo{q, b};
    return p;
}

/// A quarter of an upright ellipse, from its rightmost point to its lowest (y down).
Piece quarter(Point center, Point radii) {
    Piece p{ArcTo{radii, 0, false, true, center + Point{0, radii.y}}, {}};
    for (int i = 0; i <= steps; ++i) {
        const double a = pi / 2 * i / steps;
        p.spine.emplace_back(center + radii * Point{std::cos(a), std::sin(a)},
                             glm::normalize(radii * Point{-std::sin(a), std::cos(a)}));
    }
    return p;
}

/// The definition of SVG 2 section 13.5, as a set of polygons of which one must hold the point.
class Definition {
public:
    Definition(const std::vector<Piece>& pieces, const StrokeStyle& s, bool closed) : s_(s), r_(s.width / 2) {
        for (const Piece& p : pieces)
            sweep(p);
        for (std::size_t i = closed ? 0 : 1; i < pieces.size(); ++i)
            join(pieces[(i + pieces.size() - 1) % pieces.size()].spine.back(), pieces[i].spine.front());
        if (!closed) {
            cap(pieces.back().spine.back());
            cap({pieces.front().spine.front().first, -pieces.front().spine.front().second});
        }
    }

    bool holds(Point p) const {
        return std::any_of(discs_.begin(), discs_.end(),
                           [&](Point c) { return glm::distance(c, p) <= r_; }) ||
               std::any_of(polygons_.begin(), polygons_.end(),
                           [&](const std::vector<Point>& polygon) { return holds(polygon, p); });
    }

private:
    using Frame = std::pair<Point, Point>;  ///< point and tangent

    static bool holds(const std::vector<Point>& polygon, Point p) {
        const auto beyond = [&](auto side) { return std::all_of(polygon.begin(), polygon.end(), side); };
        if (beyond([&](Point q) { return q.y < p.y; }) || beyond([&](Point q) { return q.y > p.y; }))
            return false;
        int turns = 0;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Point a = polygon[i], b = polygon[(i + 1) % polygon.size()];
            if ((a.y > p.y) != (b.y > p.y) && ((cross(b - a, p - a) > 0) == (b.y > a.y)))
                turns += b.y > a.y ? 1 : -1;
        }
        return turns != 0;
    }

    void sweep(const Piece& p) {
        for (std::size_t i = 0; i + 1 < p.spine.size(); ++i)
            for (const double side : {-r_, r_}) {
                const auto& [a, ta] = p.spine[i];
                const auto& [b, tb] = p.spine[i + 1];
                polygons_.push_back({a, b, b + perp(tb) * side, a + perp(ta) * side});
            }
    }

    void join(const Frame& before, const Frame& after) {
        const auto [v, t0] = before;
        const Point t1 = after.second;
        if (s_.join == Join::Round)
            return discs_.push_back(v);
        const double side = cross(t0, t1) > 0 ? -r_ : r_;
        const Point a = v + perp(t0) * side, b = v + perp(t1) * side;
        polygons_.push_back({v, a, b});
        // The tip is where both offset lines meet; miterLimit·r away the clipping line crosses the bisector.
        const double half = std::acos(std::clamp(glm::dot(t0, t1), -1.0, 1.0)) / 2,
                     reach = 1 / std::cos(half);
        if (s_.join != Join::Bevel && reach <= s_.miterLimit) {
            const double along = r_ * std::tan(half);
            polygons_.push_back({a, a + t0 * along, b});
        } else if (s_.join == Join::MiterClip) {
            const double along = r_ * (s_.miterLimit - std::cos(half)) / std::sin(half);
            polygons_.push_back({a, a + t0 * along, b - t1 * along, b});
        }
    }

    void cap(const Frame& end) {
        const auto [v, ahead] = end;
        const Point side = perp(ahead) * r_;
        if (s_.cap == Cap::Round)
            discs_.push_back(v);
        if (s_.cap == Cap::Square)
            polygons_.push_back({v - side, v + side, v + side + ahead * r_, v - side + ahead * r_});
    }

    const StrokeStyle& s_;
    double r_;
    std::vector<std::vector<Point>> polygons_;
    std::vector<Point> discs_;
};

Path pathOf(const std::vector<Piece>& pieces, bool closed) {
    Path path{MoveTo{pieces.front().spine.front().first}};
    for (const Piece& p : pieces)
        path.push_back(p.command);
    if (closed)
        path.push_back(Close{});
    return path;
}

/// Points whose whole surroundings, as far as the border may err, are in the shape or out of it must be found
/// so by the outline.
void expectDefinition(const std::vector<Piece>& pieces, const StrokeStyle& s, bool closed, unsigned seed) {
    constexpr double tolerance = 0.02, polygonError = 0.02;
    const auto border = curves(strokeOutline(pathOf(pieces, closed), s, tolerance));
    const Definition definition(pieces, s, closed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0, 1);
    int decided = 0;
    for (int i = 0; i < 150; ++i) {
        const auto& spine = pieces[random() % pieces.size()].spine;
        const double a = share(random) * 2 * pi, reach = share(random) * 1.6 * s.width;
        const Point p = spine[random() % spine.size()].first + Point{std::cos(a), std::sin(a)} * reach;
        const bool in = definition.holds(p);
        bool clear = true;
        for (int k = 0; k < 8; ++k)
            clear &= definition.holds(p + Point{std::cos(k * pi / 4), std::sin(k * pi / 4)} *
                                              (tolerance + polygonError)) == in;
        if (!clear)
            continue;
        ++decided;
        ASSERT_GE(winding(border, p), 0) << p.x << "," << p.y;
        ASSERT_EQ(winding(border, p) > 0, in) << p.x << "," << p.y;
    }
    EXPECT_GT(decided, 100);
}

using Pieces = std::vector<Piece>;

/// Corners between all kinds of curves, sharp and blunt; one smooth joint; controls on their ends.
std::vector<Pieces> shapes() {
    return {
        {line({10, 10}, {40, 20}), quad({40, 20}, {60, 60}, {30, 70}), line({30, 70}, {10, 50})},
        {cubic({{{50, 20}, {90, 20}, {20, 60}, {70, 70}}}), quarter({40, 70}, {30, 20}),
         line({40, 90}, {10, 40})},
        {quarter({20, 20}, {25, 25}), quad({20, 45}, {0, 45}, {10, 10})},
        {cubic({{{10, 10}, {10, 10}, {60, 0}, {60, 40}}}), cubic({{{60, 40}, {60, 40}, {50, 80}, {20, 60}}})},
        {cubic({{{10, 10}, {80, 90}, {90, 20}, {20, 70}}}), line({20, 70}, {60, 20})}};
}

TEST(StrokeStyles, AllCapsAndJoinsOnAllCurves) {
    const std::vector<Pieces> all = shapes();
    for (const double width : {2.0, 9.0, 30.0})
        for (const Cap cap : {Cap::Butt, Cap::Round, Cap::Square})
            for (const Join join : {Join::Miter, Join::MiterClip, Join::Round, Join::Bevel})
                for (std::size_t i = 0; i < all.size(); ++i)
                    for (const bool closed : {false, true}) {
                        Pieces pieces = all[i];
                        if (closed)
                            pieces.push_back(
                                line(pieces.back().spine.back().first, pieces.front().spine.front().first));
                        StrokeStyle s = style(width, cap, join);
                        s.miterLimit = 1.7;
                        SCOPED_TRACE("shape " + std::to_string(i) + " width " + std::to_string(width) +
                                     " cap " + std::to_string(int(cap)) + " join " +
                                     std::to_string(int(join)) + (closed ? " closed" : ""));
                        expectDefinition(pieces, s, closed, unsigned(i));
                        if (HasFatalFailure())
                            return;
                    }
}

TEST(StrokeStyles, ControlsOnTheirEndsCostNoEdges) {
    // The curvature has no limit there, yet the curve turns by nothing worth an edge.
    const Path apart{MoveTo{{0, 0}}, CubicTo{{10, 10}, {50, 80}, {100, 30}}};
    const Path together{MoveTo{{0, 0}}, CubicTo{{0, 0}, {50, 80}, {100, 30}}};
    for (const double tolerance : {1e-2, 1e-3})
        EXPECT_LE(edges(strokeOutline(together, style(0.4), tolerance)),
                  2 * edges(strokeOutline(apart, style(0.4), tolerance)));
}

TEST(StrokeStyles, BordersStayWithinTheTolerance) {
    // Without tight curvature every point of both borders lies half the width from the curve.
    for (const double tolerance : {1e-1, 1e-2, 1e-4, 1e-6}) {
        const Piece piece = cubic({{{0, 0}, {20, 60}, {70, 80}, {100, 30}}});
        double worst = 0;
        for (const Curve& c : curves(strokeOutline(pathOf({piece}, false), style(10), tolerance)))
            for (int i = 0; i <= 20; ++i) {
                const Point p = at(c, i / 20.0);
                double nearest = std::numeric_limits<double>::infinity();
                // Distances to tangents: at the nearest of so many points the curve leaves its own by less
                // than 1e-3² / 2 of its radius.
                Point foot{0, 0}, along{1, 0};
                for (const auto& [on, tangent] : piece.spine)
                    if (const double d = glm::distance(on, p); d < nearest)
                        nearest = d, foot = on, along = tangent;
                if (glm::dot(p - piece.spine.front().first, piece.spine.front().second) > 0.3 &&
                    glm::dot(p - piece.spine.back().first, piece.spine.back().second) < -0.3)
                    worst = std::max(worst, std::abs(std::abs(cross(along, p - foot)) - 5));
            }
        EXPECT_LE(worst, tolerance + 2e-3) << tolerance;
        EXPECT_GT(worst, 0);
    }
}

// --- hairlines -----------------------------------------------------------------------------------------

TEST(StrokeHairlines, KeepTheirArea) {
    const Curve c{Point{0, 0}, {20, 60}, {70, 80}, {100, 30}};
    double length = 0;
    for (int i = 0; i < 10000; ++i)
        length += glm::distance(at(c, i / 10000.0), at(c, (i + 1) / 10000.0));
    const Path path{MoveTo{c[0]}, CubicTo{c[1], c[2], c[3]}};
    for (const double width : {0.5, 0.1, 0.02, 0.005})
        for (const double tolerance : {10 * width, width, 0.1 * width, 1e-3 * width})
            EXPECT_NEAR(area(strokeOutline(path, style(width), tolerance)), width * length,
                        2 * length * std::min(tolerance, width / 32))
                << width << " " << tolerance;
    // What is flat is exact.
    const Path line = polyline({{0, 0}, {30, 40}});
    EXPECT_NEAR(area(strokeOutline(line, style(0.01), 1e-3)), 0.5, 1e-12);
}

// --- dashes and segments without length ----------------------------------------------------------------

TEST(StrokeDashes, GoRoundCornersBetweenCurves) {
    // A quarter circle of radius 20 down to (0, 20), then sharply right: 31.4 along, and 20 along the line.
    const Path path{MoveTo{{20, 0}}, ArcTo{{20, 20}, 0, false, true, {0, 20}}, LineTo{{20, 25}}};
    StrokeStyle s = style(4, Cap::Butt, Join::Round);
    const double arc = 10 * pi;
    s.dashes = {arc + 8, 1000};
    const Path across = strokeOutline(path, s, 1e-3);
    EXPECT_EQ(contours(across), 1u);
    EXPECT_TRUE(inside(across, {-1.8, 20.2})) << "the join";
    const Point along = glm::normalize(Point{20, 5});
    EXPECT_TRUE(inside(across, Point{0, 20} + along * 7.9));
    EXPECT_FALSE(inside(across, Point{0, 20} + along * 8.1 + Point{-along.y, along.x} * 1.0));
    s.dashes = {arc, 1000};
    EXPECT_FALSE(inside(strokeOutline(path, s, 1e-3), {-1.8, 20.2})) << "a dash that ends there has none";
    s.dashes = {arc - 5, 10, 1000, 1};
    const Path gap = strokeOutline(path, s, 1e-3);
    EXPECT_EQ(contours(gap), 2u);
    EXPECT_FALSE(inside(gap, {0.5, 20}));
}

TEST(StrokeSegments, OfNoLengthChangeNothing) {
    const Point p{20, 10};
    for (const Join join : {Join::Miter, Join::MiterClip, Join::Round, Join::Bevel})
        for (const Cap cap : {Cap::Butt, Cap::Round, Cap::Square}) {
            const StrokeStyle s = style(3, cap, join);
            const Path plain{MoveTo{{0, 0}}, QuadTo{{10, 0}, p}, LineTo{{30, 0}}};
            for (const Command& nothing :
                 {Command{LineTo{p}}, Command{QuadTo{p, p}}, Command{CubicTo{p, p, p}},
                  Command{ArcTo{{5, 5}, 0, true, true, p}}}) {
                Path with = plain;
                with.insert(with.begin() + 2, nothing);
                EXPECT_EQ(edges(strokeOutline(with, s, 1e-3)), edges(strokeOutline(plain, s, 1e-3)));
                EXPECT_EQ(area(strokeOutline(with, s, 1e-3)), area(strokeOutline(plain, s, 1e-3)));
            }
        }
}

}  // namespace
}  // namespace vtm::compiler
