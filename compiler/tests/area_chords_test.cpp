// Chords that misplace little of a pixel's area (compiler/lower/area_chords.hpp), measured in pixels.

#include "compiler/lower/area_chords.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <vtm/compiler/stroke.hpp>
#include "compiler/lower/outline.hpp"
#include "compiler/outline_coverage.hpp"
#include "compiler/stroke/chord_joins.hpp"
#include "compiler/stroke/chords.hpp"

namespace vtm::compiler {
namespace {

constexpr int side = 24;              // pixels
constexpr double steps = 1 << 14;     // of a pixel
constexpr double area = 1.0 / 512;    // of a pixel, that an edge may misplace
constexpr double slack = 1.0 / 2048;  // tolerances of what is compared, and rounding

/// How much of each pixel lies on the right of directed edges that close.
class PixelAreas {
public:
    explicit PixelAreas(const Outlines& outlines) : own_(side * (side + 1)), right_(own_.size()) {
        for (const Run& run : outlines.runs)
            for (std::uint32_t i = run.first; i < run.last; ++i)
                edge(pointOf(outlines.points[i]), pointOf(outlines.points[i + 1]));
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                right_[at(x + 1, y)] += right_[at(x, y)];
                own_[at(x, y)] += right_[at(x, y)];
            }
    }
    double operator()(int x, int y) const { return own_[at(x, y)]; }

private:
    static scene::Point pointOf(LatticePoint p) { return {p.x / steps, p.y / steps}; }
    static std::size_t at(int x, int y) { return std::size_t(y * (side + 1) + x); }

    /// Cut at the borders of pixels.
    void edge(scene::Point a, scene::Point b) {
        std::vector<double> cuts{0, 1};
        for (int axis = 0; axis < 2; ++axis)
            for (int k = int(std::ceil(std::min(a[axis], b[axis]))); k < std::max(a[axis], b[axis]); ++k)
                cuts.push_back(std::clamp((k - a[axis]) / (b[axis] - a[axis]), 0.0, 1.0));
        std::ranges::sort(cuts);
        for (std::size_t i = 1; i < cuts.size(); ++i)
            if (cuts[i] > cuts[i - 1])
                inPixel(a + (b - a) * cuts[i - 1], a + (b - a) * cuts[i]);
    }
    void inPixel(scene::Point a, scene::Point b) {
        const scene::Point middle = 0.5 * (a + b);
        const int x = std::clamp(int(middle.x), 0, side - 1), y = std::clamp(int(middle.y), 0, side - 1);
        own_[at(x, y)] += (b.y - a.y) * (x + 1 - middle.x);
        right_[at(x + 1, y)] += b.y - a.y;
    }

    std::vector<double> own_, right_;
};

double largestDifference(const Outlines& a, const Outlines& b) {
    const PixelAreas p(a), q(b);
    double largest = 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            largest = std::max(largest, std::abs(p(x, y) - q(x, y)));
    return largest;
}

Outlines outlineOf(const scene::Path& path, ChordTolerance pixels) {
    Outlines outlines;
    addOutline(outlines, path, {steps, 0, 0, steps, 0, 0}, pixels.scaled(steps), {0, 0},
               glm::dvec2(side * steps));
    return outlines;
}
/// What an outline covers of each pixel.
std::vector<double> covered(const scene::Path& outline) {
    std::vector<double> shares(side * side);
    EXPECT_TRUE(coverOutline(outline, scene::FillRule::NonZero, {1, 0, 0, 1, 0, 0}, side, side,
                             [&](int y, std::span<const asset::CoverageRun> runs) {
                                 for (const asset::CoverageRun& run : runs)
                                     for (int x = run.first; x < run.end; ++x)
                                         shares[std::size_t(y * side + x)] = double(run.share);
                             }));
    return shares;
}
/// What a stroke covers.
std::vector<double> strokeOf(const scene::Path& path, double width, ChordTolerance pixels) {
    scene::StrokeStyle style;
    style.width = width;
    style.join = scene::Join::Round;
    style.cap = scene::Cap::Round;
    return covered(strokeOutlineOfChords(path, style, 1.0 / 4096, pixels));
}

const ChordTolerance byArea{1.0 / 256, area}, byDistance{1.0 / 256}, exact{1.0 / 8192};

struct AreaChords : testing::TestWithParam<unsigned> {
    /// Some curves that go on from each other, in a square of that size.
    scene::Path curves(double size) {
        std::uniform_real_distribution<double> coordinate(0.5 * (side - size), 0.5 * (side + size));
        const auto point = [&] { return scene::Point{coordinate(random), coordinate(random)}; };
        scene::Path path{scene::MoveTo{point()}};
        for (int i = 0; i < 3; ++i)
            path.push_back(scene::CubicTo{point(), point(), point()});
        return path;
    }
    std::mt19937 random{GetParam()};
};
INSTANTIATE_TEST_SUITE_P(Seeds, AreaChords, testing::Range(0u, 40u));

TEST_P(AreaChords, misplaceNoMoreOfAPixelThanTheyMay) {
    for (const double size : {1.0, 2.0, 5.0, 20.0}) {
        const scene::Path path = curves(size);
        const Outlines chords = outlineOf(path, byArea);
        // Of curves that turn and cross themselves at random, so many parts may pass through one pixel.
        const int edges = size < 3 ? 6 : 5;
        EXPECT_LT(largestDifference(chords, outlineOf(path, exact)), edges * area + slack) << size;
        EXPECT_LE(chords.points.size(), outlineOf(path, byDistance).points.size()) << size;
    }
}

TEST_P(AreaChords, ofStrokesToo) {
    for (const double width : {0.2, 0.6, 1.0, 4.0}) {
        const scene::Path path = curves(16);
        const std::vector<double> chords = strokeOf(path, width, byArea),
                                  truth = strokeOf(path, width, exact);
        // Both sides, as often.
        for (std::size_t i = 0; i < truth.size(); ++i)
            EXPECT_LT(std::abs(chords[i] - truth[i]), 6 * area + 4 * slack) << width << " at " << i;
    }
}

/// Most curves bend more tightly than these strokes are wide: their offsets turn with the tangent, and what
/// lies beyond evolutes shows at the caps. The same outlines of curves are the truth.
TEST_P(AreaChords, ofTightStrokesToo) {
    for (const double width : {2.0, 5.0, 10.0})
        for (const double size : {1.0, 3.0, 8.0}) {
            const scene::Path path = curves(size);
            scene::StrokeStyle style;
            style.width = width;
            style.join = GetParam() % 2 == 0 ? scene::Join::Miter : scene::Join::Round;
            style.cap = scene::Cap::Butt;
            const std::vector<double> truth = covered(strokeOutline(path, style, 1.0 / 4096));
            for (const ChordTolerance& tolerance : {byArea, byDistance, exact}) {
                const std::vector<double> chords =
                    covered(strokeOutlineOfChords(path, style, 1.0 / 4096, tolerance));
                for (std::size_t i = 0; i < truth.size(); ++i)
                    EXPECT_LT(std::abs(chords[i] - truth[i]), 6 * area + 4 * slack)
                        << width << ' ' << size << " at " << i;
            }
        }
}

/// Out to a tip and back to where it came from, or nearly so: no line between tells where the tip might go.
TEST(AreaChords, ofATipWhoseNeighboursMeetStay) {
    for (const double gap : {0.0, 1e-6}) {
        const std::vector<scene::Point> ends{{0, 0}, {0.01, 0.001}, {0.02, 0}, {0.01, -0.002}, {gap, 0}};
        stroke::Side chords{{-1, 0}, ends, {}};
        stroke::shorten({.before = {1, 0}, .after = {-1, 0}, .tip = {&chords, 2, true, true}, .detour = {}},
                        {1.0 / 256, area}, 0);
        EXPECT_EQ(chords.ends, ends) << gap;
    }
}

TEST(AreaChords, ofACircleCoverIt) {
    // Many small errors of one sign would add up.
    const scene::Path circle{scene::MoveTo{{4, 12}}, scene::ArcTo{{8, 8}, 0, false, true, {20, 12}},
                             scene::ArcTo{{8, 8}, 0, false, true, {4, 12}}, scene::Close{}};
    const auto sum = [](const PixelAreas& areas) {
        double all = 0;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                all += areas(x, y);
        return std::abs(all);
    };
    const double truth = 64 * 3.14159265358979;
    EXPECT_NEAR(sum(PixelAreas(outlineOf(circle, byArea))), truth, 0.01);
    EXPECT_GT(truth - sum(PixelAreas(outlineOf(circle, byDistance))), 0.05);
}

}  // namespace
}  // namespace vtm::compiler
