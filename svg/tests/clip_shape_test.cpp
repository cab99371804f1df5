// clip-path with shapes instead of elements.
#include "svg/css/clip_shape.hpp"
#include "svg/geometry/path_geometry.hpp"
#include "svg/tests/support.hpp"

namespace vtm::svg {
namespace {

const Box box{{10, 20}, {50, 40}};

bool isRead(std::string_view text) { return parseClipShape(text, {}).has_value(); }

Box outlineBox(std::string_view text) {
    const auto shape = parseClipShape(text, {});
    EXPECT_TRUE(shape) << text;
    return shape ? boundingBox(outlineOf(*shape, box), scene::identity) : Box{};
}

void expectBox(std::string_view text, const Box& expected) {
    const Box found = outlineBox(text);
    for (int axis = 0; axis < 2; ++axis) {
        EXPECT_NEAR(found.min[axis], expected.min[axis], 1e-4) << text;
        EXPECT_NEAR(found.max[axis], expected.max[axis], 1e-4) << text;
    }
}

TEST(ClipShape, BoxesAreShapes) {
    expectBox("fill-box", box);
    expectBox("border-box", box);
}

TEST(ClipShape, InsetsAreAsMargins) {
    expectBox("inset(1px)", {{11, 21}, {49, 39}});
    expectBox("inset(1px 2px)", {{12, 21}, {48, 39}});
    expectBox("inset(1px 2px 3px)", {{12, 21}, {48, 37}});
    expectBox("inset(1px 2px 3px 4px)", {{14, 21}, {48, 37}});
    expectBox("inset(10% 25%)", {{20, 22}, {40, 38}});
    expectBox("inset(1px round 3px)", {{11, 21}, {49, 39}});
}

TEST(ClipShape, InsetsThatMeetLeaveNothing) {
    const Box found = outlineBox("inset(0 75% 0 75%)");
    EXPECT_EQ(found.min.x, found.max.x);
}

TEST(ClipShape, Rectangles) {
    expectBox("rect(1px 30px 15px 2px)", {{12, 21}, {40, 35}});
    expectBox("rect(auto 30px auto 2px)", {{12, 20}, {40, 40}});
    expectBox("xywh(1px 2px 50% 10px)", {{11, 22}, {31, 32}});
}

TEST(ClipShape, RoundCornersShrinkTogether) {
    const auto shape = parseClipShape("inset(0 round 100px)", {});
    ASSERT_TRUE(shape);
    const scene::Path path = outlineOf(*shape, box);
    ASSERT_TRUE(std::holds_alternative<scene::ArcTo>(path.at(1)));
    EXPECT_DOUBLE_EQ(std::get<scene::ArcTo>(path.at(1)).radii.x, 10);  // half of the shorter side
    EXPECT_DOUBLE_EQ(std::get<scene::ArcTo>(path.at(1)).radii.y, 10);
}

TEST(ClipShape, Circles) {
    expectBox("circle()", {{20, 20}, {40, 40}});
    expectBox("circle(5px)", {{25, 25}, {35, 35}});
    expectBox("circle(5px at 0 100%)", {{5, 35}, {15, 45}});
    expectBox("circle(farthest-side)", {{10, 10}, {50, 50}});
    expectBox("circle(5px at right top)", {{45, 15}, {55, 25}});
    const double half = std::hypot(40, 20) / std::sqrt(2.0) / 2;
    expectBox("circle(50%)", {{30 - half, 30 - half}, {30 + half, 30 + half}});
}

TEST(ClipShape, Ellipses) {
    expectBox("ellipse()", box);
    expectBox("ellipse(50% 25%)", {{10, 25}, {50, 35}});
    expectBox("ellipse(closest-side farthest-side at 10px 5px)", {{10, 10}, {30, 40}});
}

TEST(ClipShape, Polygons) {
    expectBox("polygon(0 0, 100% 0, 50% 100%)", box);
    EXPECT_EQ(parseClipShape("polygon(evenodd, 0 0, 1px 0, 0 1px)", {})->fillRule, scene::FillRule::EvenOdd);
}

TEST(ClipShape, PathsStartAtTheCornerOfTheBox) {
    expectBox("path('M1 2H5V7Z')", {{11, 22}, {15, 27}});
    expectBox("path(evenodd, \"M1 2H5V7Z\") view-box", {{11, 22}, {15, 27}});
    EXPECT_TRUE(parseClipShape("path('M1 2H5V7Z') view-box", {})->box == TransformBox::View);
}

TEST(ClipShape, WhatIsNoShapeIsNotRead) {
    for (const char* text : {"",
                             "circle",
                             "circle(",
                             "circle(-1px)",
                             "circle(1px 2px)",
                             "ellipse(1px)",
                             "polygon()",
                             "polygon(0 0, 1)",
                             "inset()",
                             "inset(1px round)",
                             "inset(1px round -1px)",
                             "path(M0 0)",
                             "path('M0 0 X')",
                             "circle() circle()",
                             "fill-box view-box",
                             "circle() nonsense",
                             "star(5)",
                             "rect(1px 2px 3px)",
                             "xywh(0 0 -1px 2px)",
                             "circle(1px at)",
                             "circle(1px) \"x\""})
        EXPECT_FALSE(isRead(text)) << text;
}

TEST(ClipShape, ClipsElements) {
    const auto group = groupOf(
        "<g transform='translate(7 0)'><rect id='r' x='10' y='20' width='40' height='20' "
        "style='clip-path:circle(5px)'/></g>");
    ASSERT_TRUE(group.clip);
    const Box found = boundingBox(*group.clip->shapes.at(0).path, group.clip->shapes.at(0).transform);
    EXPECT_NEAR(found.min.x, 32, 1e-4);
    EXPECT_NEAR(found.max.y, 35, 1e-4);
}

TEST(ClipShape, NonsenseIsAWarningAndNoClip) {
    const Document loaded = loadBody("<rect width='9' height='9' clip-path='circle(-1)'/>");
    ASSERT_EQ(loaded.warnings.size(), 1u);
    EXPECT_TRUE(std::holds_alternative<scene::Item>(loaded.scene.root.children.at(0).value));
}

TEST(MaskMode, WinsOverTheMasksOwnType) {
    const std::string masks = "<mask id='m'><rect width='9' height='9'/></mask>";
    const auto kindOf = [&](const std::string& style) {
        const auto group = groupOf(masks + "<rect width='9' height='9' style='" + style + "'/>");
        EXPECT_TRUE(group.mask) << style;
        return group.mask ? group.mask->kind : scene::MaskKind{};
    };
    EXPECT_EQ(kindOf("mask:url(#m)"), scene::MaskKind::Luminance);
    EXPECT_EQ(kindOf("mask:url(#m) alpha"), scene::MaskKind::Alpha);
    EXPECT_EQ(kindOf("mask:url(#m) no-repeat 50% 50% / cover alpha"), scene::MaskKind::Alpha);
    EXPECT_EQ(kindOf("mask-image:url(#m);mask-mode:alpha"), scene::MaskKind::Alpha);
    EXPECT_EQ(kindOf("mask-mode:alpha;mask:url(#m)"), scene::MaskKind::Luminance);
}

}  // namespace
}  // namespace vtm::svg
