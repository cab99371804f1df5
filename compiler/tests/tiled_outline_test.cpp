// Outlines in all tiles of a pattern against the outline in one of them, and the tiles that a shape meets.

#include "compiler/patterns/tiled_outline.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "compiler/planar/clipped_run.hpp"

namespace vtm::compiler {
namespace {

using scene::Point;

constexpr Coord side = 1024;
constexpr glm::dvec2 outsideMin(-20000, -20000), outsideMax(20000, 20000);

Outlines inTile(const scene::Path& path) {
    Outlines tile;
    addOutline(tile, path, scene::identity, 0.5, {0, 0}, {side, side});
    return tile;
}

Tiling tilingOf(int columns, int rows, const scene::Affine& toOutside) {
    return {side, std::vector<TileSpan>(std::size_t(rows), TileSpan{0, columns}), toOutside};
}

Outlines tiled(const scene::Path& path, const Tiling& tiling) {
    Outlines outlines;
    addTiled(outlines, inTile(path), tiling, outsideMin, outsideMax);
    return outlines;
}

int windingAt(const Outlines& outlines, LatticePoint p) {
    int w = 0;
    for (const Run& run : outlines.runs)
        w += windingAlongX(outlines.points, {run.first, run.last, 0}, p.y, Coord(outsideMin.x) - 1, p.x);
    return w;
}

std::size_t chordsOf(const Outlines& outlines) {
    std::size_t chords = 0;
    for (const Run& run : outlines.runs)
        chords += run.last - run.first;
    return chords;
}

TEST(TiledOutline, TilesThatAreFilledAreABox) {
    const Outlines box =
        tiled(scene::rectangle({-5, -5}, {2000, 2000}), tilingOf(7, 5, {0.5, 0, 0, 0.5, 0, 0}));
    EXPECT_LE(chordsOf(box), 5u);  // it may begin in the middle of a side
    EXPECT_EQ(windingAt(box, {1, 1}), windingAt(box, {7 * 512 - 1, 5 * 512 - 1}));
    EXPECT_NE(windingAt(box, {1, 1}), 0);
    EXPECT_EQ(windingAt(box, {7 * 512 + 1, 1}), 0);
}

TEST(TiledOutline, LinesAcrossTilesAreLong) {
    constexpr int columns = 9, rows = 4;
    const Outlines lines = tiled(scene::rectangle({-100, 300}, {2000, 500}),
                                 tilingOf(columns, rows, {0.6, 0.2, -0.2, 0.6, 0, 0}));
    EXPECT_LE(chordsOf(lines), std::size_t(5 * rows));
}

double distance(const Outlines& outlines, glm::dvec2 p) {
    double least = INFINITY;
    for (const Run& run : outlines.runs)
        for (std::uint32_t i = run.first; i < run.last; ++i) {
            const glm::dvec2 a(outlines.points[i].x, outlines.points[i].y),
                d = glm::dvec2(outlines.points[i + 1].x, outlines.points[i + 1].y) - a;
            least = std::min(
                least, glm::length(p - a - glm::clamp(glm::dot(p - a, d) / glm::dot(d, d), 0.0, 1.0) * d));
        }
    return least;
}

TEST(TiledOutline, WindingNumbersAreThoseInTheTile) {
    int asked = 0;
    std::mt19937 random(7);
    const auto between = [&](double a, double b) { return std::uniform_real_distribution(a, b)(random); };
    for (int round = 0; round < 200; ++round) {
        scene::Path path;
        for (int contour = 0; contour < 3; ++contour) {
            const auto point = [&] {  // some on the borders
                const auto coordinate = [&] {
                    return random() % 4 == 0 ? double(random() % 2) * side : between(-0.4 * side, 1.4 * side);
                };
                return Point(coordinate(), coordinate());
            };
            path.push_back(scene::MoveTo{point()});
            for (int i = 0; i < 4; ++i)
                path.push_back(scene::LineTo{point()});
            if (round % 3 == 0)
                path.push_back(scene::CubicTo{point(), point(), point()});
            path.push_back(scene::Close{});
        }
        const double angle = between(0, 6), scale = between(0.6, 1.5);
        Tiling tiling = tilingOf(6, 5,
                                 {scale * std::cos(angle), scale * std::sin(angle), -std::sin(angle),
                                  1.1 * std::cos(angle), between(-9, 9), between(-9, 9)});
        for (TileSpan& row : tiling.rows)
            row = {int(random() % 3), int(random() % 7)};
        const Outlines tile = inTile(path), all = tiled(path, tiling);
        const auto toTiles = scene::inverse(tiling.toOutside);
        for (int i = 0; i < 300; ++i) {
            const glm::dvec2 in =
                between(-side, 7 * side) * glm::dvec2(1, 0) + between(-side, 6 * side) * glm::dvec2(0, 1);
            const glm::dvec2 outside = glm::round(scene::apply(tiling.toOutside, in) / 2.0) * 2.0 + 1.0;
            const LatticePoint at{Coord(outside.x), Coord(outside.y)};
            const glm::dvec2 p = scene::apply(*toTiles, outside);
            const glm::dvec2 number = glm::floor(p / double(side)), inOne = p - number * double(side);
            const bool isSeen = number.y >= 0 && number.y < double(tiling.rows.size()) &&
                                tiling.rows[std::size_t(number.y)].holds(int(number.x));
            // Near an outline or a border rounding decides.
            constexpr double near = 12;
            const glm::dvec2 toBorder = glm::min(inOne, double(side) - inOne);
            if (std::min(toBorder.x, toBorder.y) < near || distance(tile, inOne) < near)
                continue;
            const LatticePoint q{Coord(inOne.x / 2) * 2 + 1, Coord(inOne.y / 2) * 2 + 1};
            ASSERT_EQ(windingAt(all, at), isSeen ? windingAt(tile, q) : 0)
                << round << ": " << p.x << ", " << p.y;
            ++asked;
        }
    }
    EXPECT_GE(asked, 20000);
}

TEST(TileSpans, HoldAllTilesThatAShapeMeets) {
    std::mt19937 random(3);
    const auto between = [&](double a, double b) { return std::uniform_real_distribution(a, b)(random); };
    const scene::Pattern pattern{{1, 2}, {4, 4.5}, nullptr, scene::identity};
    const TileRange range{{-5, -7}, {20, 30}};
    for (int round = 0; round < 100; ++round) {
        Point corners[3];
        for (Point& corner : corners)
            corner = {between(-14, 63), between(-15, 79)};
        TileSpans spans(range, pattern);
        for (int i = 0; i < 3; ++i)
            spans.add(corners[i], corners[(i + 1) % 3], Point(0.001));
        const std::vector<TileSpan> rows = spans.take();
        ASSERT_EQ(rows.size(), 38u);
        for (int i = 0; i < 100; ++i) {
            const double u = between(0, 1), v = between(0, 1 - u);
            const Point p = corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0]);
            const Point tile = glm::floor((p - pattern.min) / (pattern.max - pattern.min)) - range.first;
            ASSERT_TRUE(rows[std::size_t(tile.y)].holds(int(tile.x))) << round;
        }
    }
}

}  // namespace
}  // namespace vtm::compiler
