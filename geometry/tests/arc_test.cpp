#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "geometry/arc.hpp"

namespace vtm::geometry {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double rounding = 1e-12;  // of numbers up to a hundred

std::vector<EndpointArc> someArcs() {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> number(-10, 10), radius(15, 30);
    std::vector<EndpointArc> result;
    for (int i = 0; i < 200; ++i) {
        const auto point = [&] { return Point(number(random), number(random)); };
        result.push_back({point(),
                          {radius(random), -radius(random)},
                          number(random),
                          (i & 1) != 0,
                          (i & 2) != 0,
                          point()});
    }
    return result;
}

TEST(CenterForm, MeetsBothEndsTheWayThatItIsAsked) {
    for (const EndpointArc& a : someArcs()) {
        const auto arc = centerForm(a);
        ASSERT_TRUE(arc);
        EXPECT_LT(glm::distance(arc->at(arc->start), a.from), rounding);
        EXPECT_LT(glm::distance(arc->at(arc->start + arc->sweep), a.to), rounding);
        EXPECT_EQ(arc->sweep > 0, a.sweep);
        EXPECT_EQ(std::abs(arc->sweep) > pi, a.largeArc);
        EXPECT_NEAR(glm::length(arc->axisX), std::abs(a.radii.x), rounding);
        EXPECT_NEAR(glm::length(arc->axisY), std::abs(a.radii.y), rounding);
        EXPECT_NEAR(glm::dot(arc->axisX, arc->axisY), 0, 1e-10);
    }
}

TEST(CenterForm, SmallRadiiGrowToAHalfEllipse) {
    const auto arc = centerForm({{0, 0}, {1, 2}, 0, true, false, {10, 0}});
    ASSERT_TRUE(arc);
    EXPECT_EQ(arc->center, Point(5, 0));
    EXPECT_DOUBLE_EQ(arc->axisX.x, 5);
    EXPECT_DOUBLE_EQ(arc->axisY.y, 10);
    EXPECT_DOUBLE_EQ(arc->sweep, -pi);
}

TEST(CenterForm, IsNothingWhereNoEllipseIsMeant) {
    EXPECT_FALSE(centerForm({{1, 1}, {3, 3}, 0, false, true, {1, 1}}));
    EXPECT_FALSE(centerForm({{0, 0}, {0, 3}, 0, false, true, {1, 1}}));
    EXPECT_FALSE(centerForm({{0, 0}, {3, 0}, 0, false, true, {1, 1}}));
    EXPECT_FALSE(centerForm({{0, 0}, {1e-300, 1e-300}, 0, false, true, {1e9, 0}}));
    EXPECT_FALSE(centerForm({{0, 0}, {1e300, 1e300}, 0, false, true, {1, 0}}));
    EXPECT_FALSE(centerForm({{0, 0}, {1, 1}, 0, false, true, {std::nan(""), 0}}));
}

TEST(Cubics, StrayByNoMoreThanStated) {
    for (const double angle : {pi / 2, pi / 4, pi / 16}) {
        const EllipticalArc quarter{{0, 0}, {1, 0}, {0, 1}, 0.3, angle};
        double strays = 0;
        for (int i = 0; i <= 256; ++i)
            strays = std::max(strays, std::abs(glm::length(cubics(quarter, 1)[0].at(i / 256.0)) - 1));
        EXPECT_LE(strays, cubicArcError(angle) + 1e-15);
        EXPECT_GT(strays, 0.5 * cubicArcError(angle));
    }
}

TEST(Cubics, FollowMappedArcs) {
    for (const EndpointArc& a : someArcs()) {
        const EllipticalArc arc = mapped(*centerForm(a), {1, 0.25, -0.5, 2, 3, 4});
        const int count = cubicCount(arc, pi / 16);
        const std::vector<Cubic> pieces = cubics(arc, count);
        ASSERT_EQ(int(pieces.size()), count);
        for (int i = 0; i < count; ++i)
            for (const double t : {0.0, 0.5, 1.0})
                EXPECT_LT(glm::distance(pieces[std::size_t(i)].at(t),
                                        arc.at(arc.start + arc.sweep * (i + t) / count)),
                          100 * cubicArcError(pi / 16));
    }
}

TEST(Cubics, AreAsManyAsTheToleranceAsksFor) {
    const double angle = cubicArcAngle(100, 1e-3);
    EXPECT_LE(100 * cubicArcError(angle), 1e-3);
    EXPECT_GT(100 * cubicArcError(angle * 1.1), 1e-3);
    EXPECT_EQ(cubicCount({{}, {1, 0}, {0, 1}, 0, -2 * pi}, pi / 2), 4);
    EXPECT_EQ(cubicArcAngle(1, 1), pi / 2);
}

TEST(Arcs, BoundsAreTight) {
    for (const EndpointArc& a : someArcs()) {
        const EllipticalArc arc = *centerForm(a);
        Box seen;
        for (int i = 0; i <= 4096; ++i)
            seen.add(arc.at(arc.start + arc.sweep * i / 4096));
        const Box box = bounds(arc);
        EXPECT_TRUE(Box({box.min - rounding, box.max + rounding}).contains(seen));
        // Between two samples an extremum rises by radius / 8 · (2π / 4096)².
        EXPECT_TRUE(Box({seen.min - 1e-4, seen.max + 1e-4}).contains(box));
    }
}

}  // namespace
}  // namespace vtm::geometry
