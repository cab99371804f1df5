#include <gtest/gtest.h>

#include "geometry/box.hpp"

namespace vtm::geometry {
namespace {

TEST(Box, IsEmptyUntilAPointIsAdded) {
    Box box;
    EXPECT_TRUE(box.empty());
    EXPECT_TRUE(Box().contains(box));
    box.add({3, -2});
    EXPECT_FALSE(box.empty());
    EXPECT_EQ(box.width(), 0);
    EXPECT_TRUE(box.contains(Box()));
    EXPECT_FALSE(Box().contains(box));
}

TEST(Box, IntersectionsOfDisjointBoxesAreEmpty) {
    const Box a{{0, 0}, {2, 2}}, b{{1, -1}, {5, 1}}, c{{3, 0}, {4, 1}};
    EXPECT_EQ(a.intersection(b).min, Point(1, 0));
    EXPECT_EQ(a.intersection(b).max, Point(2, 1));
    EXPECT_TRUE(a.intersection(c).empty());
}

TEST(Box, MappedBoxesHoldTheMappedCorners) {
    const glm::dmat3x2 turn{0, 1, -1, 0, 10, 20};  // by a quarter, then moved
    const Box box = mapped(Box{{1, 2}, {3, 7}}, turn);
    EXPECT_EQ(box.min, Point(3, 21));
    EXPECT_EQ(box.max, Point(8, 23));
    EXPECT_TRUE(mapped(Box(), turn).empty());
}

}  // namespace
}  // namespace vtm::geometry
