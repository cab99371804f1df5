#include "svg/geometry/path_geometry.hpp"
#include "svg/tests/support.hpp"

namespace vtm::svg {
namespace {

/// The transforms of a marker's rect, in the order in which they are drawn.
std::vector<scene::Affine> markersOn(const std::string& marker, const std::string& shape) {
    std::vector<scene::Affine> transforms;
    for (const scene::Item& item : itemsOf(loadBody("<marker id='m' overflow='visible' " + marker +
                                                    "><rect width='1' height='1'/></marker>" + shape)))
        transforms.push_back(item.transform);
    return transforms;
}
std::string path(const std::string& data, const std::string& which = "marker-start") {
    return "<path fill='none' stroke-width='2' d='" + data + "' " + which + "='url(#m)'/>";
}

TEST(Marker, StandsAtItsVertexInStrokeWidths) {
    const auto at = markersOn("", path("M 10 20 H 50"));
    ASSERT_EQ(at.size(), 1u);
    expectNear(at[0], {2, 0, 0, 2, 10, 20});
}
TEST(Marker, AppliesWhateverItsDisplay) {
    EXPECT_EQ(markersOn("display='none'", path("M 10 20 H 50")).size(), 1u);
}
TEST(Marker, MayUseUserUnits) {
    expectNear(markersOn("markerUnits='userSpaceOnUse'", path("M 10 20 H 50")).at(0), {1, 0, 0, 1, 10, 20});
}
TEST(Marker, ReferencePointLiesOnTheVertex) {
    expectNear(markersOn("refX='3' refY='1'", path("M 10 20 H 50")).at(0), {2, 0, 0, 2, 4, 18});
}
TEST(Marker, ReferencePointIsInTheViewBox) {
    const auto at = markersOn("viewBox='0 0 10 10' markerWidth='5' markerHeight='5' refX='center' refY='5'",
                              path("M 10 20 H 50"));
    expectNear(at.at(0), {1, 0, 0, 1, 5, 15});
}
TEST(Marker, MidMarkersStandBetween) {
    EXPECT_EQ(markersOn("", path("M 0 0 H 1 H 2 H 3", "marker-mid")).size(), 2u);
    expectNear(markersOn("", path("M 0 0 H 1 H 2 H 3", "marker-end")).at(0)[2], {3, 0});
}
TEST(Marker, PropertyMarkerSetsAll) {
    EXPECT_EQ(markersOn("", "<path fill='none' d='M 0 0 H 1 H 2' style='marker:url(#m)'/>").size(), 3u);
}
TEST(Marker, OrientsItself) {
    expectNear(markersOn("orient='auto'", path("M 0 0 V 5")).at(0), {0, 2, -2, 0, 0, 0});
    expectNear(markersOn("orient='90'", path("M 0 0 H 5")).at(0), {0, 2, -2, 0, 0, 0});
    expectNear(markersOn("orient='auto-start-reverse'", path("M 0 0 V 5")).at(0), {0, -2, 2, 0, 0, 0});
}
TEST(Marker, OrientsItselfByTheBisector) {
    const auto at = markersOn("orient='auto'", path("M 0 0 H 5 V 5", "marker-mid"));
    EXPECT_NEAR(at.at(0)[0].x, at.at(0)[0].y, 1e-12);
}
TEST(Marker, IsClippedToItsViewport) {
    const auto group = groupOf("<marker id='m'><rect width='9' height='1'/></marker>" + path("M 10 20 H 50"));
    ASSERT_TRUE(group.clip);
    expectNear(boundingBox(*group.clip->shapes.at(0).path, group.clip->shapes.at(0).transform).max, {16, 26});
}
TEST(Marker, ContextPaintIsTheShapes) {
    EXPECT_EQ(
        fillOf("<marker id='m'><rect width='1' height='1' fill='context-stroke'/></marker>"
               "<path fill='none' d='M 0 0 M 5 5' stroke='lime' stroke-width='1' marker-start='url(#m)' "
               "stroke-opacity='0'/>"),
        0x00ff00);
}
TEST(Marker, InACircleEnds) {
    EXPECT_EQ(itemsOf(loadBody("<marker id='m'><path d='M0 0H1V1' marker-start='url(#m)'/></marker>" +
                               path("M 10 20 H 50")))
                  .size(),
              1u);
}
TEST(Marker, WithoutASizeIsNotDrawn) { EXPECT_TRUE(markersOn("markerWidth='0'", path("M 0 0 H 5")).empty()); }

}  // namespace
}  // namespace vtm::svg
