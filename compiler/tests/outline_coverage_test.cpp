// Coverage without a map, beside that of the map: within 1/255.

#include "compiler/outline_coverage.hpp"

#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include <vtm/compiler/stroke.hpp>
#include "compiler/coverage_map.hpp"

namespace vtm::compiler {
namespace {

using scene::FillRule;
using scene::Path;
using scene::Point;

constexpr int width = 61, height = 47;
constexpr double tolerance = 1.0 / (1 << 18);
constexpr float step = 1.0f / 255;

struct Pixels {
    std::vector<float> shares = std::vector<float>(std::size_t(width) * height);

    /// Takes rows in order, and runs in order that lie apart.
    auto sink() {
        return [this, last = -1](int y, std::span<const asset::CoverageRun> runs) mutable {
            ASSERT_GT(y, last);
            last = y;
            int end = 0;
            for (const asset::CoverageRun& run : runs) {
                ASSERT_LE(end, run.first);
                ASSERT_LT(run.first, run.end);
                end = run.end;
                ASSERT_LE(end, width);
                ASSERT_GT(run.share, 0);
                ASSERT_LE(run.share, 1);
                std::fill(&shares[std::size_t(y * width + run.first)], &shares[std::size_t(y * width)] + end,
                          run.share);
            }
        };
    }
};

Pixels direct(const Path& path, FillRule rule, const scene::Affine& toPixels = scene::identity) {
    Pixels pixels;
    EXPECT_TRUE(coverOutline(path, rule, toPixels, width, height, pixels.sink()));
    return pixels;
}

Pixels ofMap(const Path& path, FillRule rule, const scene::Affine& toPixels = scene::identity) {
    Pixels pixels;
    asset::CoverageScanner(coverageMap(std::make_shared<const Path>(path), rule, toPixels, {width, height},
                                       {.tolerance = tolerance}))
        .scan({width, height, scene::identity}, pixels.sink());
    return pixels;
}

void expectNear(const Pixels& is, const Pixels& expected, const std::string& what) {
    int wrong = 0;
    for (int i = 0; i < width * height; ++i)
        if (!(std::abs(is.shares[std::size_t(i)] - expected.shares[std::size_t(i)]) <= step) && ++wrong == 1)
            ADD_FAILURE() << what << ", pixel " << i % width << ' ' << i / width << ": "
                          << is.shares[std::size_t(i)] * 255 << " is not "
                          << expected.shares[std::size_t(i)] * 255;
    EXPECT_EQ(wrong, 0) << what;
}

void expectThatOfTheMap(const Path& path, const std::string& what,
                        const scene::Affine& toPixels = scene::identity) {
    for (const FillRule rule : {FillRule::NonZero, FillRule::EvenOdd})
        expectNear(direct(path, rule, toPixels), ofMap(path, rule, toPixels),
                   what + (rule == FillRule::NonZero ? ", non-zero" : ", even-odd"));
}

class OutlineCoverage : public ::testing::Test {
protected:
    double number(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
    Point point(double low, double high) { return {number(low, high), number(low, high)}; }

    Path lines(int contours, int count, double low, double high) {
        Path path;
        for (int i = 0; i < contours; ++i) {
            path.push_back(scene::MoveTo{point(low, high)});
            for (int k = 1; k < count; ++k)
                path.push_back(scene::LineTo{point(low, high)});
            path.push_back(scene::Close{});
        }
        return path;
    }
    Path curves(int contours, int count, double low, double high) {
        Path path;
        for (int i = 0; i < contours; ++i) {
            path.push_back(scene::MoveTo{point(low, high)});
            for (int k = 0; k < count; ++k)
                path.push_back(scene::CubicTo{point(low, high), point(low, high), point(low, high)});
        }
        return path;
    }

    std::mt19937 random_{20};
};

TEST_F(OutlineCoverage, Lines) {
    for (int i = 0; i < 40; ++i)
        expectThatOfTheMap(lines(1 + i % 3, 3 + i % 9, 2, 45), "lines " + std::to_string(i));
}

TEST_F(OutlineCoverage, Curves) {
    for (int i = 0; i < 40; ++i)
        expectThatOfTheMap(curves(1 + i % 3, 1 + i % 5, 2, 45), "curves " + std::to_string(i));
}

TEST_F(OutlineCoverage, BeyondTheView) {
    for (int i = 0; i < 30; ++i) {
        const double far = std::pow(10, 1 + i % 6);
        expectThatOfTheMap(lines(2, 3 + i % 5, 30 - far, 30 + far), "lines to " + std::to_string(far));
        expectThatOfTheMap(curves(1, 3, 30 - far, 30 + far), "curves to " + std::to_string(far));
    }
}

// Much in few pixels: points, hairs, tangles.
TEST_F(OutlineCoverage, Tiny) {
    for (int i = 0; i < 60; ++i) {
        const double size = std::pow(10, -3 + i % 4), low = number(5, 40);
        expectThatOfTheMap(curves(2, 3, low, low + size), "curves of " + std::to_string(size));
        expectThatOfTheMap(lines(1, 5 + i, low, low + size), "lines of " + std::to_string(size));
    }
    for (const int count : {100, 1000})
        expectThatOfTheMap(lines(1, count, 20.2, 21.7), std::to_string(count) + " lines");
}

// On borders of pixels, along them, and through their corners.
TEST_F(OutlineCoverage, OnTheGrid) {
    for (int i = 0; i < 200; ++i) {
        Path path = lines(1 + i % 4, 3 + i % 5, -3, 50);
        const double grid = i % 3 == 0 ? 1 : i % 3 == 1 ? 0.5 : 4;
        for (scene::Command& command : path)
            std::visit(
                [&](auto& c) {
                    if constexpr (requires { c.to; })
                        c.to = glm::round(c.to / grid) * grid;
                },
                command);
        expectThatOfTheMap(path, "on a grid, " + std::to_string(i));
    }
    for (const double at : {0.0, 0.25, 1.0})
        for (const Point size : {Point(7, 9), Point(61, 47), Point(100, 100), Point(0.5, 20)})
            expectThatOfTheMap(scene::rectangle({at, at}, Point(at) + size), "a rectangle");
}

// More edges in a pixel than are solved pair by pair.
TEST_F(OutlineCoverage, Crowded) {
    for (int i = 0; i < 5; ++i)
        expectThatOfTheMap(lines(1, 100 << i / 2, 20, 28), "crowded, " + std::to_string(i));
}

// The same contour there and back, twice, thrice: nothing, or all.
TEST_F(OutlineCoverage, Coincident) {
    for (int i = 0; i < 20; ++i) {
        const Path once = lines(1, 4, 3, 44);
        Path all = once;
        for (int k = 0; k < 1 + i % 3; ++k)
            all.insert(all.end(), once.begin(), once.end());
        expectThatOfTheMap(all, "the same again");
        Path back{once[0]};
        for (const std::size_t k : {1u, 2u, 3u, 2u, 1u})
            back.push_back(once[k]);
        for (const float share : direct(back, FillRule::NonZero).shares)
            ASSERT_EQ(share, 0);
    }
}

TEST_F(OutlineCoverage, Strokes) {
    for (int i = 0; i < 30; ++i) {
        scene::StrokeStyle style{.width = std::pow(10, number(-1.5, 1)), .dashes = {}};
        style.join = i % 3 == 0 ? scene::Join::Round : i % 3 == 1 ? scene::Join::Miter : scene::Join::Bevel;
        style.cap = i % 2 == 0 ? scene::Cap::Round : scene::Cap::Square;
        if (i % 5 == 0)
            style.dashes = {3, 2};
        const Path line = i % 2 == 0 ? curves(1, 3, 5, 42) : lines(1, 12, 5, 42);
        expectThatOfTheMap(strokeOutline(line, style, 1e-4), "a stroke " + std::to_string(style.width));
    }
}

TEST_F(OutlineCoverage, UnderMatrices) {
    for (int i = 0; i < 30; ++i) {
        const double turn = number(0, 7), zoom = std::pow(10, number(-3, 3));
        const scene::Affine map{zoom * std::cos(turn), zoom * std::sin(turn), -std::sin(turn) * zoom * 0.3,
                                zoom * std::cos(turn), number(10, 50),        number(10, 40)};
        expectThatOfTheMap(curves(2, 4, -20, 20), "zoomed " + std::to_string(zoom), map);
    }
}

TEST_F(OutlineCoverage, ArcsAndSpikes) {
    Path arcs{scene::MoveTo{{10, 10}}, scene::ArcTo{{20, 12}, 0.3, true, true, {40, 30}},
              scene::ArcTo{{8, 8}, 0, false, false, {10, 10}}};
    expectThatOfTheMap(arcs, "arcs");
    Path star;
    for (int i = 0; i < 101; ++i) {
        const double a = i * 50 * 2 * std::numbers::pi / 101;
        const Point p = Point(30, 23) + 22.0 * Point(std::cos(a), std::sin(a));
        i == 0 ? star.push_back(scene::MoveTo{p}) : star.push_back(scene::LineTo{p});
    }
    expectThatOfTheMap(star, "a star");
    for (int i = 0; i < 20; ++i) {
        const Point tip = point(5, 40);
        expectThatOfTheMap({scene::MoveTo{{1, 1.2 + i}}, scene::LineTo{tip}, scene::LineTo{{1, 1.25 + i}}},
                           "a spike");
    }
}

TEST_F(OutlineCoverage, OfNothing) {
    const auto expectNone = [](const Path& path) {
        for (const float share : direct(path, FillRule::EvenOdd).shares)
            ASSERT_EQ(share, 0);
    };
    expectNone({});
    expectNone({scene::MoveTo{{5, 5}}});
    expectNone({scene::MoveTo{{5, 5}}, scene::LineTo{{30, 20}}, scene::Close{}});
    expectNone(scene::rectangle({-50, 3}, {0, 20}));
    expectNone(scene::rectangle({61, 3}, {90, 20}));
    expectNone(scene::rectangle({3, 47}, {9, 60}));
    expectNone(scene::rectangle({3, -60}, {9, 0}));
}

// What crosses itself everywhere is left to the map, which has limits.
TEST_F(OutlineCoverage, RefusesTooMuch) {
    const auto none = [](int, std::span<const asset::CoverageRun>) { FAIL(); };
    EXPECT_FALSE(
        coverOutline(lines(1, 300000, 0, 47), FillRule::EvenOdd, scene::identity, width, height, none));
    EXPECT_FALSE(coverOutline({}, FillRule::EvenOdd, scene::identity, (1 << 14) + 1, 1, none));
}

}  // namespace
}  // namespace vtm::compiler
