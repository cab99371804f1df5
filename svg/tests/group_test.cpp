#include "svg/geometry/path_geometry.hpp"
#include "svg/tests/support.hpp"

namespace vtm::svg {
namespace {

constexpr std::string_view two = "<rect width='9' height='9'/><rect x='5' width='9' height='9'/>";

std::size_t count(std::string_view body) { return itemsOf(loadBody(body)).size(); }
std::string grouped(const std::string& attributes, std::string_view content = two) {
    return "<g " + attributes + ">" + std::string(content) + "</g>";
}

TEST(Opacity, MakesAGroup) { EXPECT_FLOAT_EQ(groupOf(grouped("opacity='0.5'")).opacity, 0.5f); }
TEST(Opacity, OfASingleItemIsItsOwn) {
    EXPECT_FLOAT_EQ(itemOf("<g opacity='0.5'><rect opacity='50%' width='9' height='9'/></g>").opacity, 0.25f);
}
TEST(Opacity, IsClamped) {
    EXPECT_EQ(loadBody(grouped("opacity='3'")).scene.root.children.size(), 2u);
    EXPECT_EQ(count(grouped("opacity='-1'")), 0u);
}
TEST(Blend, MakesAGroup) {
    EXPECT_EQ(groupOf("<rect width='9' height='9' style='mix-blend-mode:multiply'/>").blend,
              scene::BlendMode::Multiply);
}
TEST(Blend, IsNoAttribute) {
    EXPECT_TRUE(std::holds_alternative<scene::Item>(
        loadBody("<rect width='9' height='9' mix-blend-mode='multiply'/>").scene.root.children.at(0).value));
}
TEST(Isolation, KeepsAGroupOnlyAroundBlending) {
    EXPECT_EQ(loadBody(grouped("style='isolation:isolate'")).scene.root.children.size(), 2u);
    const auto group = groupOf(
        grouped("style='isolation:isolate'", "<rect width='9' height='9' style='mix-blend-mode:screen'/>"));
    EXPECT_EQ(group.blend, scene::BlendMode::Normal);
    EXPECT_EQ(group.children.size(), 1u);
}

scene::Clip clipOf(const std::string& clips, const std::string& attributes = "") {
    const auto group = groupOf(clips + grouped("clip-path='url(#c)' " + attributes));
    EXPECT_TRUE(group.clip);
    return group.clip ? *group.clip : scene::Clip{};
}

TEST(Clip, UnitesItsChildren) {
    const auto clip = clipOf(
        "<clipPath id='c' clip-rule='evenodd'><circle r='5'/><rect width='3' height='3' "
        "clip-rule='nonzero'/></clipPath>");
    ASSERT_EQ(clip.shapes.size(), 2u);
    EXPECT_EQ(clip.shapes[0].rule, scene::FillRule::EvenOdd);
    EXPECT_EQ(clip.shapes[1].rule, scene::FillRule::NonZero);
}
TEST(Clip, TransformsMultiply) {
    const auto clip = clipOf(
        "<clipPath id='c' transform='scale(2)'><rect width='3' height='3' transform='scale(5)'/>"
        "</clipPath>",
        "transform='translate(1 2)'");
    expectNear(clip.shapes.at(0).transform, {10, 0, 0, 10, 1, 2});
}
TEST(Clip, BoxUnitsMapTheBoxOfTheGroup) {
    const auto clip =
        clipOf("<clipPath id='c' clipPathUnits='objectBoundingBox'><rect width='1' height='1'/></clipPath>");
    expectNear(clip.shapes.at(0).transform, {14, 0, 0, 9, 0, 0});
}
TEST(Clip, OfTheClipPathCutsFurther) {
    EXPECT_TRUE(clipOf("<clipPath id='c' clip-path='url(#d)'><rect width='3' height='3'/></clipPath>"
                       "<clipPath id='d'><circle r='5'/></clipPath>")
                    .clip);
}
TEST(Clip, OfAChildCutsTheChild) {
    EXPECT_TRUE(clipOf("<clipPath id='c'><rect width='3' height='3' clip-path='url(#d)'/></clipPath>"
                       "<clipPath id='d'><circle r='5'/></clipPath>")
                    .shapes.at(0)
                    .clip);
}
TEST(Clip, TakesUsedShapes) {
    const auto clip = clipOf(
        "<clipPath id='c'><use href='#r' x='7'/></clipPath><defs><rect id='r' width='3' height='3'/></defs>");
    expectNear(clip.shapes.at(0).transform, scene::translation(7, 0));
}
TEST(Clip, TakesNoGroups) {
    EXPECT_TRUE(clipOf("<clipPath id='c'><g><rect width='3' height='3'/></g></clipPath>").shapes.empty());
}
TEST(Clip, HiddenChildrenDoNotCount) {
    EXPECT_TRUE(clipOf("<clipPath id='c'><rect width='3' height='3' visibility='hidden'/></clipPath>")
                    .shapes.empty());
}
TEST(Clip, MissingOneIsIgnoredWithAWarning) {
    const Document loaded = loadBody(grouped("clip-path='url(#no)'"));
    EXPECT_EQ(itemsOf(loaded).size(), 2u);
    EXPECT_EQ(loaded.warnings.size(), 1u);
}
TEST(Clip, InACircleEnds) {
    EXPECT_FALSE(clipOf("<clipPath id='c' clip-path='url(#c)'><rect width='3' height='3'/></clipPath>").clip);
}

scene::Mask maskOf(const std::string& attributes,
                   const std::string& content = "<rect width='5' height='5'/>") {
    const auto group =
        groupOf("<mask id='m' " + attributes + ">" + content + "</mask>" + grouped("mask='url(#m)'"));
    EXPECT_TRUE(group.mask);
    return group.mask ? *group.mask : scene::Mask{};
}

TEST(Mask, IsOfLuminanceByDefault) { EXPECT_EQ(maskOf("").kind, scene::MaskKind::Luminance); }
TEST(Mask, TypeMayBeAlpha) { EXPECT_EQ(maskOf("mask-type='alpha'").kind, scene::MaskKind::Alpha); }
TEST(Mask, ColoursMayBeLinear) {
    EXPECT_FALSE(maskOf("").linear);
    EXPECT_TRUE(maskOf("color-interpolation='linearRGB'").linear);
}
TEST(Mask, IsClippedToItsRegion) {
    const auto mask = maskOf("maskUnits='userSpaceOnUse' x='1' y='2' width='3' height='4'");
    const auto& group = std::get<scene::Group>(mask.content->children.at(0).value);
    ASSERT_TRUE(group.clip);
    const Box box = boundingBox(*group.clip->shapes.at(0).path, group.clip->shapes.at(0).transform);
    expectNear(box.min, {1, 2});
    expectNear(box.max, {4, 6});
}
TEST(Mask, RegionIsATenthMoreThanTheBox) {
    const auto mask = maskOf("", "<rect width='100' height='100'/>");
    const auto& group = std::get<scene::Group>(mask.content->children.at(0).value);
    const Box box = boundingBox(*group.clip->shapes.at(0).path, group.clip->shapes.at(0).transform);
    expectNear(box.min, {-1.4, -0.9});
    expectNear(box.max, {15.4, 9.9});
}
TEST(Mask, BoxContentUnitsMapTheBox) {
    const auto mask = maskOf("maskContentUnits='objectBoundingBox'", "<rect width='1' height='1'/>");
    expectNear(std::get<scene::Item>(mask.content->children.at(0).value).transform, {14, 0, 0, 9, 0, 0});
}
TEST(Mask, OfTheMaskMultiplies) {
    const auto group = groupOf(
        "<mask id='m' mask='url(#n)'><rect width='5' height='5'/></mask><mask id='n'>"
        "<rect width='5' height='5'/></mask>" +
        grouped("mask='url(#m)'"));
    EXPECT_TRUE(group.mask->content->mask);
}
TEST(Mask, InACircleEnds) {
    const auto group =
        groupOf("<mask id='m' mask='url(#m)'><rect width='5' height='5' mask='url(#m)'/></mask>" +
                grouped("mask='url(#m)'"));
    EXPECT_FALSE(group.mask->content->mask);
}
TEST(Mask, WithoutABoxHidesEverything) {
    const auto group = groupOf(
        "<mask id='m'><rect width='5' height='5'/></mask>"
        "<path d='M0 0H9' stroke='red' mask='url(#m)'/>");
    ASSERT_TRUE(group.mask);
    EXPECT_TRUE(group.mask->content->children.empty());
}

}  // namespace
}  // namespace vtm::svg
