#include "svg/geometry/path_geometry.hpp"
#include "svg/tests/support.hpp"

namespace vtm::svg {
namespace {

Box boxOf(std::string_view body) {
    const scene::Item item = itemOf(body);
    return boundingBox(*item.path, item.transform);
}
bool drawsNothing(std::string_view body) { return itemsOf(loadBody(body)).empty(); }

scene::StrokeStyle strokeOf(std::string_view attributes) {
    const scene::Item item =
        itemOf("<path d='M 0 0 H 10' fill='none' stroke='red' " + std::string(attributes) + "/>");
    return std::get<scene::StrokeStyle>(item.geometry);
}

TEST(Shape, Rect) {
    const Box box = boxOf("<rect x='1' y='2' width='30' height='40'/>");
    expectNear(box.min, {1, 2});
    expectNear(box.max, {31, 42});
}
TEST(Shape, RectWithoutASizeIsNotDrawn) {
    EXPECT_TRUE(drawsNothing("<rect width='10'/>"));
    EXPECT_TRUE(drawsNothing("<rect width='10' height='-1'/>"));
    EXPECT_TRUE(drawsNothing("<rect width='0' height='1'/>"));
}
scene::Point cornerRadii(std::string_view attributes) {
    const scene::Item item = itemOf("<rect width='20' height='10' " + std::string(attributes) + "/>");
    for (const scene::Command& command : *item.path)
        if (const auto* arc = std::get_if<scene::ArcTo>(&command))
            return arc->radii;
    return {0, 0};
}
TEST(Shape, RectRadiiFollowEachOther) {
    expectNear(cornerRadii("rx='3'"), {3, 3});
    expectNear(cornerRadii("ry='3' rx='auto'"), {3, 3});
    expectNear(cornerRadii("rx='2' ry='-1'"), {2, 2});
}
TEST(Shape, RectRadiiAreAtMostHalfTheSides) { expectNear(cornerRadii("rx='30' ry='40'"), {10, 5}); }
TEST(Shape, RectWithoutARadiusHasCorners) { expectNear(cornerRadii("rx='0' ry='5'"), {0, 0}); }

TEST(Shape, Circle) {
    const Box box = boxOf("<circle cx='50' cy='40' r='10'/>");
    expectNear(box.min, {40, 30});
    expectNear(box.max, {60, 50});
}
TEST(Shape, CircleWithoutARadiusIsNotDrawn) { EXPECT_TRUE(drawsNothing("<circle cx='5' cy='5' r='0'/>")); }
TEST(Shape, EllipseTakesAMissingRadiusFromTheOther) {
    const Box box = boxOf("<ellipse cx='50' cy='50' rx='10'/>");
    expectNear(box.max, {60, 60});
}
TEST(Shape, LineHasNoArea) {
    EXPECT_TRUE(drawsNothing("<line x2='10' fill='red'/>"));
    EXPECT_FALSE(drawsNothing("<line x2='10' stroke='red'/>"));
}
TEST(Shape, PolygonCloses) {
    EXPECT_TRUE(std::holds_alternative<scene::Close>(itemOf("<polygon points='0 0 5 0 5 5'/>").path->back()));
    EXPECT_FALSE(
        std::holds_alternative<scene::Close>(itemOf("<polyline points='0 0 5 0 5 5'/>").path->back()));
}
TEST(Shape, PercentagesReferToTheViewport) {
    const Box box = boxOf("<rect x='10%' width='50%' height='25%'/>");
    expectNear(box.min, {10, 0});
    expectNear(box.max, {60, 25});
}
TEST(Shape, HugeCoordinatesAreLeftOut) {
    EXPECT_TRUE(drawsNothing("<path d='M 0 0 L 1e38 1 L 5 5'/>"));
    EXPECT_TRUE(drawsNothing("<rect width='9' height='9' transform='scale(1e20)'/>"));
    EXPECT_FALSE(loadBody("<path d='M 0 0 L 1e38 1 L 5 5'/>").warnings.empty());
}
TEST(Shape, FlatteningTransformsLeaveNothing) {
    EXPECT_TRUE(drawsNothing("<rect width='9' height='9' transform='scale(0 1)'/>"));
}
TEST(Shape, HiddenShapesAreNotDrawnButTheirVisibleChildrenAre) {
    EXPECT_TRUE(drawsNothing("<rect width='9' height='9' visibility='hidden'/>"));
    EXPECT_FALSE(
        drawsNothing("<g visibility='hidden'><rect width='9' height='9' visibility='visible'/></g>"));
}
TEST(Shape, ControlsThatLieOnTheirEndsButForRoundingDoNotTurnCaps) {
    const auto strokeOf = [](const std::string& data) {
        return *itemOf("<path fill='none' stroke='red' stroke-width='8' d='" + data + "'/>").path;
    };
    const auto cubic =
        std::get<scene::CubicTo>(strokeOf("M 5 5 C 5.001 5.001 40 9 40.0012 9.001 H 60").at(1));
    EXPECT_EQ(cubic.control1, scene::Point(5, 5));
    EXPECT_NE(cubic.control2, scene::Point(40, 9));
    const auto meant = std::get<scene::CubicTo>(strokeOf("M 5 5 C 5.01 5.01 40 9 40 9").at(1));
    EXPECT_EQ(meant.control1, scene::Point(5.01, 5.01));
    EXPECT_TRUE(std::holds_alternative<scene::LineTo>(strokeOf("M 5 5 Q 5 5.001 40 9").at(1)));
    EXPECT_TRUE(std::holds_alternative<scene::CubicTo>(
        *std::next(itemOf("<path d='M 5 5 C 5.0001 5.0001 40 9 40 9'/>").path->begin())));
}
TEST(Shape, MayTurnAboutItsOwnBox) {
    const std::string style =
        "style='transform-box: fill-box; transform-origin: center; transform: rotate(90deg)'";
    const std::string rect = "<rect x='20' y='30' width='10' height='4' ";
    const auto centre = [](const scene::Item& item) { return scene::apply(item.transform, {25, 32}); };
    expectNear(centre(itemOf(rect + style + "/>")), {25, 32});
    expectNear(centre(itemOf("<g " + style + ">" + rect + "/></g>")), {25, 32});
    expectNear(centre(itemOf("<g " + style + "><g " + style + ">" + rect + "/></g></g>")), {25, 32});
    // Without an origin it is the box's corner; percentages of translations are the box's.
    const std::string corner = "style='transform-box: fill-box; transform: ";
    expectNear(scene::apply(itemOf(rect + corner + "scale(2)'/>").transform, {20, 30}), {20, 30});
    expectNear(scene::apply(itemOf(rect + corner + "translate(50%, 100%)'/>").transform, {20, 30}), {25, 34});
}
TEST(Shape, UndisplayedGroupsAreNotDrawn) {
    EXPECT_TRUE(drawsNothing("<g display='none'><rect width='9' height='9' display='inline'/></g>"));
}
TEST(Shape, EvenOddIsKept) {
    EXPECT_EQ(std::get<scene::FillRule>(itemOf("<rect width='9' height='9' fill-rule='evenodd'/>").geometry),
              scene::FillRule::EvenOdd);
}

TEST(Stroke, TakesItsProperties) {
    const auto style =
        strokeOf("stroke-width='3' stroke-linecap='round' stroke-linejoin='bevel' stroke-miterlimit='7'");
    EXPECT_EQ(style.width, 3);
    EXPECT_EQ(style.cap, scene::Cap::Round);
    EXPECT_EQ(style.join, scene::Join::Bevel);
    EXPECT_EQ(style.miterLimit, 7);
}
TEST(Stroke, InvalidValuesKeepTheDefaults) {
    const auto style = strokeOf("stroke-width='-3' stroke-linecap='miter' stroke-miterlimit='0.5'");
    EXPECT_EQ(style.width, 1);
    EXPECT_EQ(style.cap, scene::Cap::Butt);
    EXPECT_EQ(style.miterLimit, 4);
}
TEST(Stroke, WithoutWidthIsNone) {
    EXPECT_TRUE(drawsNothing("<path d='M 0 0 H 10' stroke='red' stroke-width='0'/>"));
}
TEST(Stroke, OddDashesAreDoubled) {
    EXPECT_EQ(strokeOf("stroke-dasharray='1 2,3'").dashes, (std::vector<double>{1, 2, 3, 1, 2, 3}));
}
TEST(Stroke, DashesTakeUnitsAndPercentages) {
    EXPECT_EQ(strokeOf("stroke-dasharray='1in 10%'").dashes, (std::vector<double>{96, 10}));
}
TEST(Stroke, NegativeOrEmptyDashesAreSolid) {
    EXPECT_TRUE(strokeOf("stroke-dasharray='5 -1'").dashes.empty());
    EXPECT_TRUE(strokeOf("stroke-dasharray='0 0'").dashes.empty());
    EXPECT_TRUE(strokeOf("stroke-dasharray='none'").dashes.empty());
}
TEST(Stroke, PathLengthScalesDashes) {
    const auto style = strokeOf("pathLength='5' stroke-dasharray='1 2' stroke-dashoffset='1'");
    EXPECT_EQ(style.dashes, (std::vector<double>{2, 4}));
    EXPECT_EQ(style.dashPhase, 2);
}
TEST(Stroke, NonScalingStrokeIsMadeInThePicture) {
    const scene::Item item =
        itemOf("<path d='M 0 0 H 10' transform='scale(5)' stroke='red' vector-effect='non-scaling-stroke'/>");
    expectNear(item.transform, scene::identity);
    expectNear(std::get<scene::LineTo>(item.path->at(1)).to, {50, 0});
}
TEST(Stroke, FollowsTheFill) {
    const auto items = itemsOf(loadBody("<rect width='9' height='9' stroke='red'/>"));
    ASSERT_EQ(items.size(), 2u);
    EXPECT_TRUE(std::holds_alternative<scene::StrokeStyle>(items[1].geometry));
    EXPECT_EQ(items[0].path, items[1].path);
}
TEST(Stroke, PaintOrderTurnsItRound) {
    const auto items = itemsOf(loadBody("<rect width='9' height='9' stroke='red' paint-order='stroke'/>"));
    ASSERT_EQ(items.size(), 2u);
    EXPECT_TRUE(std::holds_alternative<scene::StrokeStyle>(items[0].geometry));
}

}  // namespace
}  // namespace vtm::svg
