#include <vtm/scene/fit.hpp>

#include <gtest/gtest.h>

namespace vtm::scene {
namespace {

void expectNear(Point a, Point b) {
    EXPECT_NEAR(a.x, b.x, 1e-12);
    EXPECT_NEAR(a.y, b.y, 1e-12);
}

void expectRect(const Rect& a, const Rect& b) {
    expectNear({a.x, a.y}, {b.x, b.y});
    expectNear({a.width, a.height}, {b.width, b.height});
}

/// A picture of 40 × 20 units, where the corners of what is framed are drawn.
Point drawnAt(const Framing& framing, Point p) { return apply(frame(framing, 40, 20).toPixels(), p); }

Point sizeOf(const Framing& framing) {
    const Frame made = frame(framing, 40, 20);
    return {made.width, made.height};
}

constexpr Rect square{10, 20, 100, 100};

TEST(Fit, ContainShowsAllAndCoverLeavesNothingEmpty) {
    expectRect(fittedRect(40, 20, {}, square), {10, 45, 100, 50});
    expectRect(fittedRect(40, 20, {Fit::Cover}, square), {-40, 20, 200, 100});
    expectRect(fittedRect(40, 20, {Fit::Stretch}, square), square);
}

TEST(Fit, FreeSpaceIsShared) {
    expectRect(fittedRect(40, 20, {Fit::Contain, 0, 0}, square), {10, 20, 100, 50});
    expectRect(fittedRect(40, 20, {Fit::Contain, 1, 1}, square), {10, 70, 100, 50});
    expectRect(fittedRect(40, 20, {Fit::Cover, 0, 0}, square), {10, 20, 200, 100});
    expectRect(fittedRect(40, 20, {Fit::Cover, 1, 1}, square), {-90, 20, 200, 100});
}

TEST(Fit, MapsContentToItsPlace) {
    const Affine map = fittedMap({5, 6, 40, 20}, {}, square);
    expectNear(apply(map, {5, 6}), {10, 45});
    expectNear(apply(map, {45, 26}), {110, 95});
}

TEST(Framing, SizesThatAreNotGivenFollowTheAspect) {
    EXPECT_EQ(sizeOf({}), Point(40, 20));
    EXPECT_EQ(sizeOf({.scale = 2.5}), Point(100, 50));
    EXPECT_EQ(sizeOf({.width = 100}), Point(100, 50));
    EXPECT_EQ(sizeOf({.height = 100}), Point(200, 100));
    EXPECT_EQ(sizeOf({.width = 1}), Point(1, 1));
    EXPECT_EQ(sizeOf({.width = 33, .part = Rect{0, 0, 10, 1000}}), Point(33, 3300));
}

TEST(Framing, APartFillsARoundedRaster) {
    const Framing framing{.width = 33};  // 16.5 high
    EXPECT_EQ(sizeOf(framing), Point(33, 17));
    expectNear(drawnAt(framing, {40, 20}), {33, 17});
}

TEST(Framing, BothSizesFitByThePlacement) {
    Framing framing{.width = 60, .height = 60};
    EXPECT_EQ(sizeOf(framing), Point(60, 60));
    expectNear(drawnAt(framing, {0, 0}), {0, 15});
    expectNear(drawnAt(framing, {40, 20}), {60, 45});
    framing.placement.fit = Fit::Cover;
    expectNear(drawnAt(framing, {0, 0}), {-30, 0});
    framing.placement.alignX = 0;
    expectNear(drawnAt(framing, {40, 20}), {120, 60});
    framing.placement.fit = Fit::Stretch;
    expectNear(drawnAt(framing, {40, 20}), {60, 60});
}

TEST(Framing, QuarterTurnsAreExact) {
    const Point corners[]{{20, 0}, {40, 20}, {0, 40}, {0, 0}};  // of the picture's (0, 0), clockwise
    for (int quarter = 1; quarter <= 8; ++quarter) {
        const Framing framing{.rotation = 90.0 * quarter};
        EXPECT_EQ(sizeOf(framing), quarter % 2 == 1 ? Point(20, 40) : Point(40, 20));
        EXPECT_EQ(drawnAt(framing, {0, 0}), corners[(quarter + 3) % 4]);
        EXPECT_EQ(drawnAt({.rotation = -270.0 + 90 * quarter}, {0, 0}), corners[quarter % 4]);
    }
}

TEST(Framing, OtherTurnsHoldTheWholePart) {
    const Framing framing{.rotation = 30};
    EXPECT_EQ(sizeOf(framing), Point(45, 37));  // 40 cos 30 + 20 sin 30, 40 sin 30 + 20 cos 30: 44.6, 37.3
    for (const Point corner : {Point{0, 0}, Point{40, 0}, Point{0, 20}, Point{40, 20}}) {
        const Point p = drawnAt(framing, corner);
        EXPECT_TRUE(p.x >= -1e-9 && p.x <= 45 + 1e-9 && p.y >= -1e-9 && p.y <= 37 + 1e-9)
            << p.x << ' ' << p.y;
    }
    EXPECT_GT(drawnAt(framing, {40, 0}).y, drawnAt(framing, {0, 0}).y);  // clockwise
}

TEST(Framing, SeenIsWhatTheRasterShows) {
    expectRect(frame({.width = 60, .height = 60}, 40, 20).seen(), {0, -10, 40, 40});
    expectRect(frame({.part = Rect{1, 2, 3, 4}, .rotation = 90}, 40, 20).seen(), {1, 2, 3, 4});
    // The box of a square raster on its corner is twice as large.
    const Rect turned = frame({.rotation = 45}, 10, 10).seen();
    EXPECT_NEAR(turned.x + turned.width / 2, 5, 1e-12);
    EXPECT_GE(turned.width, 20);
}

TEST(Framing, DeepZoomsKeepTheirPlace) {
    const double at = 20.3, size = 0x1p-40;
    const Frame made = frame({.width = 16, .part = Rect{at, at, size, size}}, 40, 20);
    const Affine map = made.toPixels({at, at}, {0x1p44, 0x1p44});
    EXPECT_EQ(map, Affine(1, 0, 0, 1, 0, 0));
}

}  // namespace
}  // namespace vtm::scene
