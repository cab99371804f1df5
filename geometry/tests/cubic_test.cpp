#include <random>

#include <gtest/gtest.h>

#include "geometry/cubic.hpp"
#include "geometry/length.hpp"

namespace vtm::geometry {
namespace {

std::vector<Cubic> someCubics() {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-10, 10);
    std::vector<Cubic> result{{{0, 0}, {0, 0}, {5, 5}, {5, 5}},
                              {{1, 2}, {1, 2}, {1, 2}, {1, 2}},
                              {{0, 0}, {10, 10}, {-10, 10}, {0, 0}},
                              straightCubic({1, 1}, {4, -3})};
    for (int i = 0; i < 200; ++i) {
        const auto point = [&] { return Point(number(random), number(random)); };
        result.push_back({point(), point(), point(), point()});
    }
    return result;
}

constexpr int samples = 64;
constexpr double rounding = 1e-13;  // of numbers up to a hundred

TEST(Cubic, PartsRunAlongTheCurve) {
    for (const Cubic& c : someCubics()) {
        const Cubic piece = part(c, 0.25, 0.75);
        const auto [first, second] = halves(c);
        for (int i = 0; i <= samples; ++i) {
            const double t = double(i) / samples;
            EXPECT_LT(glm::distance(piece.at(t), c.at(0.25 + t / 2)), rounding);
            EXPECT_LT(glm::distance(first.at(t), c.at(t / 2)), rounding);
            EXPECT_LT(glm::distance(second.at(t), c.at(0.5 + t / 2)), rounding);
        }
        EXPECT_EQ(part(c, 0, 1).p0, c.p0);
        EXPECT_EQ(part(c, 0, 1).p3, c.p3);
    }
}

TEST(Cubic, RaisedQuadraticsAreTheSameCurve) {
    const Point a(0, 1), b(5, 7), c(-3, 2);
    for (int i = 0; i <= samples; ++i) {
        const double t = double(i) / samples, s = 1 - t;
        EXPECT_LT(glm::distance(raised(a, b, c).at(t), s * s * a + 2 * s * t * b + t * t * c), rounding);
    }
}

TEST(Cubic, StraysFromItsChordByChordErrorAtMost) {
    double largestShare = 0;
    for (const Cubic& c : someCubics()) {
        const double bound = chordError(c);
        for (int i = 0; i <= samples; ++i) {
            const double t = double(i) / samples, strays = glm::distance(c.at(t), glm::mix(c.p0, c.p3, t));
            EXPECT_LE(strays, bound + rounding);
            if (bound > 0)
                largestShare = std::max(largestShare, strays / bound);
        }
    }
    EXPECT_GT(largestShare, 0.9);  // the bound is no larger than it must be
}

TEST(Cubic, BoundsAreTight) {
    for (const Cubic& c : someCubics()) {
        const Box box = bounds(c);
        EXPECT_TRUE(controlBox(c).contains({box.min + rounding, box.max - rounding}));
        Box seen;
        for (int i = 0; i <= 4096; ++i)
            seen.add(c.at(i / 4096.0));
        EXPECT_TRUE(Box({box.min - rounding, box.max + rounding}).contains(seen));
        // Between two samples an extremum rises by |p''| / 8 · (1 / 4096)².
        EXPECT_TRUE(Box({seen.min - 1e-5, seen.max + 1e-5}).contains(box));
    }
}

TEST(Length, OfACubicIsThatOfItsChords) {
    for (const Cubic& c : someCubics()) {
        const auto speed = [&](double t) { return glm::length(c.derivative(t)); };
        double chords = 0;
        for (int i = 0; i < 4096; ++i)
            chords += glm::distance(c.at(i / 4096.0), c.at((i + 1) / 4096.0));
        EXPECT_NEAR(arcLength(speed, 0, 1, 1e-9), chords, 1e-4);
    }
}

}  // namespace
}  // namespace vtm::geometry
