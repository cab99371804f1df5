#include <vtm/scene/affine.hpp>

#include <gtest/gtest.h>

#include <vtm/scene/path.hpp>

namespace vtm::scene {
namespace {

TEST(Affine, AppliesLikeSvg) {
    const Affine m{2, 3, 5, 7, 11, 13};  // matrix(2 3 5 7 11 13)
    EXPECT_EQ(apply(m, {1, 0}), glm::dvec2(13, 16));
    EXPECT_EQ(apply(m, {0, 1}), glm::dvec2(16, 20));
    EXPECT_EQ(applyVector(m, {1, 1}), glm::dvec2(7, 10));
    EXPECT_EQ(determinant(m), -1);
}

TEST(Affine, ComposesInnerFirst) {
    const Affine m = compose(translation(10, 0), scaling(2, 3));
    EXPECT_EQ(apply(m, {1, 1}), glm::dvec2(12, 3));
}

TEST(Affine, InverseUndoes) {
    const Affine m{2, 3, 5, 7, 11, 13};
    const Affine back = inverse(m).value();
    for (const Point p : {Point{0, 0}, Point{1, 0}, Point{-4, 9}}) {
        EXPECT_NEAR(apply(back, apply(m, p)).x, p.x, 1e-12);
        EXPECT_NEAR(apply(back, apply(m, p)).y, p.y, 1e-12);
    }
}

TEST(Affine, FlatMapsHaveNoInverse) {
    EXPECT_FALSE(inverse(scaling(1, 0)));
    EXPECT_FALSE(inverse({1, 2, 2, 4, 0, 0}));
    EXPECT_FALSE(inverse(scaling(1e-200, 1e-200)));
    EXPECT_FALSE(inverse({1e-200, 0, 0, 1e-100, 1e300, 0})) << "its shift is beyond doubles";
}

TEST(Path, RectangleIsClosed) {
    const Path path = rectangle({1, 2}, {3, 5});
    ASSERT_EQ(path.size(), 5u);
    EXPECT_EQ(std::get<MoveTo>(path[0]).to, Point(1, 2));
    EXPECT_EQ(std::get<LineTo>(path[2]).to, Point(3, 5));
    EXPECT_TRUE(std::holds_alternative<Close>(path[4]));
}

TEST(Path, PolygonsAreClosedThroughTheirPoints) {
    const Path path = polygon({{1, 2}, {3, 4}, {5, 6}});
    ASSERT_EQ(path.size(), 4u);
    EXPECT_TRUE(std::holds_alternative<MoveTo>(path[0]));
    EXPECT_EQ(endOf(path[0]), Point(1, 2));
    EXPECT_EQ(endOf(path[2]), Point(5, 6));
    EXPECT_TRUE(std::holds_alternative<Close>(path[3]));
}

TEST(Path, CommandsEndWhereTheySay) {
    EXPECT_EQ(endOf(CubicTo{{1, 1}, {2, 2}, {3, 4}}), Point(3, 4));
    EXPECT_EQ(endOf(ArcTo{{1, 1}, 0, false, true, {7, 8}}), Point(7, 8));
    EXPECT_EQ(endOf(Close{}), std::nullopt);
}

}  // namespace
}  // namespace vtm::scene
