// Filters: what the scene gets of elements, properties and functions.

#include <gtest/gtest.h>

#include "svg/tests/support.hpp"

namespace vtm::svg {
namespace {

using scene::FilterInput;

/// A rectangle from (20, 10) to (60, 40) with the filter `f` of that content.
Document filteredRect(std::string_view content, std::string_view attributes = "") {
    return loadBody("<filter id='f' " + std::string(attributes) + ">" + std::string(content) +
                    "</filter><rect x='20' y='10' width='40' height='30' filter='url(#f)'/>");
}

/// Of the first group.
scene::Filter filterIn(const Document& loaded) {
    const scene::NodeList& nodes = loaded.scene.root.children;
    const auto* group = nodes.empty() ? nullptr : std::get_if<scene::Group>(&nodes.front().value);
    EXPECT_TRUE(group && group->filter);
    return group && group->filter ? *group->filter : scene::Filter{};
}

std::size_t drawnIn(std::string_view body) { return loadBody(body).scene.root.children.size(); }

scene::Filter filterMade(std::string_view content, std::string_view attributes = "") {
    return filterIn(filteredRect(content, attributes));
}

/// The operation of the first primitive.
template <class Operation>
Operation first(std::string_view content, std::string_view attributes = "") {
    const scene::Filter filter = filterMade(content, attributes);
    const auto* operation =
        filter.primitives.empty() ? nullptr : std::get_if<Operation>(&filter.primitives[0].operation);
    EXPECT_TRUE(operation) << content;
    return operation ? *operation : Operation{};
}

scene::Filter functionMade(std::string_view value) {
    return filterIn(
        loadBody("<rect width='9' height='9' style='color:#0000ff;filter:" + std::string(value) + "'/>"));
}

/// Groups that the style leaves, inside each other.
std::size_t filtersOf(std::string_view style) {
    const Document loaded =
        loadBody("<rect width='9' height='9' style='filter:" + std::string(style) + "'/>");
    std::size_t count = 0;
    const scene::NodeList* nodes = &loaded.scene.root.children;
    while (nodes->size() == 1) {
        const auto* group = std::get_if<scene::Group>(&nodes->front().value);
        if (!group)
            break;
        count += group->filter ? 1 : 0;
        nodes = &group->children;
    }
    return count;
}

TEST(Filter, RegionIsATenthLargerThanTheBox) {
    const scene::Filter filter = filterMade("<feOffset/>");
    expectNear(filter.min, {16, 7});
    expectNear(filter.max, {64, 43});
}

TEST(Filter, RegionInUserSpace) {
    const scene::Filter filter =
        filterMade("<feOffset/>", "filterUnits='userSpaceOnUse' x='1' y='2' width='30' height='40'");
    expectNear(filter.min, {1, 2});
    expectNear(filter.max, {31, 42});
}

TEST(Filter, RegionIsInheritedByHref) {
    const Document loaded = loadBody(
        "<filter id='a' x='0' y='0' width='1'><feFlood/></filter><filter id='b' href='#a' height='0.5'/>"
        "<rect x='20' y='10' width='40' height='30' filter='url(#b)'/>");
    const scene::Filter filter = filterIn(loaded);
    expectNear(filter.max, {60, 25});
    EXPECT_TRUE(std::holds_alternative<scene::FloodFilter>(filter.primitives[0].operation));
}

TEST(Filter, TransformIsThatOfTheElement) {
    const Document loaded = loadBody(
        "<filter id='f'><feOffset/></filter>"
        "<g transform='translate(5 7)'><rect width='4' height='4' filter='url(#f)' "
        "transform='scale(2)'/></g>");
    expectNear(filterIn(loaded).transform, {2, 0, 0, 2, 5, 7});
}

TEST(Filter, SubregionsDefaultToThoseOfTheInputs) {
    const scene::Filter filter = filterMade(
        "<feFlood x='20' y='10' width='5' height='6'/><feOffset dx='1'/><feTile/><feOffset "
        "in='SourceGraphic'/>");
    ASSERT_EQ(filter.primitives.size(), 4u);
    expectNear(filter.primitives[1].max, {25, 16});
    expectNear(filter.primitives[2].max, {64, 43});
    expectNear(filter.primitives[3].min, {16, 7});
}

TEST(Filter, PrimitiveUnitsOfTheBox) {
    const std::string_view box = "primitiveUnits='objectBoundingBox'";
    const auto blur = first<scene::GaussianBlurFilter>("<feGaussianBlur stdDeviation='0.1'/>", box);
    EXPECT_FLOAT_EQ(blur.deviationX, 4);
    EXPECT_FLOAT_EQ(blur.deviationY, 3);
    const scene::Filter filter = filterMade("<feFlood x='0.5' y='50%' width='0.25'/>", box);
    expectNear(filter.primitives[0].min, {40, 25});
    EXPECT_NEAR(filter.primitives[0].max.x, 50, 1e-9);
}

TEST(Filter, InputsAreNamed) {
    const scene::Filter filter = filterMade(
        "<feFlood result='a'/><feOffset in='SourceAlpha'/><feComposite in2='a'/><feOffset in='nobody'/>");
    EXPECT_EQ(filter.primitives[1].inputs[0].kind, FilterInput::Kind::SourceAlpha);
    EXPECT_EQ(filter.primitives[2].inputs[0].result, 1u);
    EXPECT_EQ(filter.primitives[2].inputs[1].result, 0u);
    EXPECT_EQ(filter.primitives[3].inputs[0].result, 2u);
    EXPECT_EQ(filterMade("<feOffset in='nobody'/>").primitives[0].inputs[0].kind,
              FilterInput::Kind::SourceGraphic);
}

TEST(Filter, FillPaintIsAPicture) {
    const scene::Filter filter = filterMade("<feOffset in='FillPaint'/><feOffset/>");
    ASSERT_EQ(filter.primitives.size(), 3u);
    EXPECT_TRUE(std::holds_alternative<scene::PictureFilter>(filter.primitives[0].operation));
    EXPECT_EQ(filter.primitives[1].inputs[0].result, 0u);
    EXPECT_EQ(filter.primitives[2].inputs[0].result, 1u);
}

TEST(Filter, ColoursAreComputedInLinearLightUnlessToldOtherwise) {
    EXPECT_TRUE(filterMade("<feOffset/>").primitives[0].linear);
    EXPECT_FALSE(filterMade("<feOffset color-interpolation-filters='sRGB'/>").primitives[0].linear);
    EXPECT_FALSE(filterMade("<feOffset/>", "color-interpolation-filters='sRGB'").primitives[0].linear);
}

TEST(Filter, ValuesInError) {
    EXPECT_EQ(first<scene::GaussianBlurFilter>("<feGaussianBlur stdDeviation='-1'/>").deviationX, 0);
    EXPECT_EQ(first<scene::GaussianBlurFilter>("<feGaussianBlur stdDeviation='1 2 3'/>").deviationX, 0);
    EXPECT_EQ(first<scene::MorphologyFilter>("<feMorphology radius='-2'/>").radiusX, 1);
    EXPECT_EQ(first<scene::ColorMatrixFilter>("<feColorMatrix values='1 2'/>").matrix[0], 1);
    EXPECT_EQ(first<scene::FloodFilter>("<feConvolveMatrix order='2' kernelMatrix='1 2 3'/>").color.a, 0);
    EXPECT_EQ(first<scene::FloodFilter>("<feDiffuseLighting/>").color.a, 0);
    EXPECT_EQ(filteredRect("<feDiffuseLighting/>").warnings.size(), 1u);
}

TEST(Filter, ConvolutionsDivisor) {
    const auto divisor = [](std::string_view attributes) {
        return first<scene::ConvolveMatrixFilter>("<feConvolveMatrix order='2' " + std::string(attributes) +
                                                  "/>")
            .divisor;
    };
    EXPECT_FLOAT_EQ(divisor("kernelMatrix='1 2 3 4'"), 10);
    EXPECT_FLOAT_EQ(divisor("kernelMatrix='1 -1 2 -2'"), 1);
    EXPECT_FLOAT_EQ(divisor("kernelMatrix='0.1 0.1 0.1 -0.3'"), 1);
    EXPECT_FLOAT_EQ(divisor("kernelMatrix='1 2 3 4' divisor='5'"), 5);
}

TEST(Filter, LightsAndTheirColours) {
    const auto light = first<scene::LightingFilter>(
        "<feSpecularLighting specularExponent='5' lighting-color='#ff0000'><desc/><fePointLight x='1' z='3'/>"
        "<feDistantLight/></feSpecularLighting>");
    EXPECT_TRUE(light.specular);
    EXPECT_EQ(light.color.g, 0);
    const auto* point = std::get_if<scene::PointLight>(&light.light);
    ASSERT_TRUE(point);
    EXPECT_EQ(point->position[2], 3);
}

TEST(Filter, OfSeveralFunctionsTheLastCounts) {
    const auto transfer = first<scene::ComponentTransferFilter>(
        "<feComponentTransfer><feFuncG type='linear' slope='2'/><feFuncG type='gamma' exponent='3'/>"
        "</feComponentTransfer>");
    EXPECT_EQ(transfer.functions[1].kind, scene::TransferFunction::Kind::Gamma);
    EXPECT_TRUE(transfer.functions[0].values.empty());
}

TEST(Filter, ImagesOfElementsMoveToTheSubregion) {
    const scene::Filter filter =
        filterIn(loadBody("<defs><rect id='r' width='2' height='2'/></defs><filter id='f'><feImage href='#r' "
                          "x='30' y='20'/></filter>"
                          "<rect x='20' y='10' width='40' height='30' filter='url(#f)'/>"));
    const auto& picture = std::get<scene::PictureFilter>(filter.primitives[0].operation);
    ASSERT_EQ(picture.content->children.size(), 1u);
    expectNear(std::get<scene::Item>(picture.content->children[0].value).transform, {1, 0, 0, 1, 30, 20});
}

TEST(Filter, ElementsThatAreNotDrawn) {
    EXPECT_EQ(drawnIn("<rect width='1' height='1' filter='url(#f)'/>"), 0u);
    EXPECT_EQ(drawnIn("<filter id='f'/><rect width='1' height='1' filter='url(#f)'/>"), 0u);
    EXPECT_EQ(
        drawnIn("<filter id='f' width='0'><feOffset/></filter><rect width='1' height='1' filter='url(#f)'/>"),
        0u);
    EXPECT_EQ(drawnIn("<filter id='f'><feOffset/></filter><path d='M0,0V9' stroke='red' filter='url(#f)'/>"),
              0u);
}

TEST(Filter, EmptyGroupsAreFilteredToo) {
    const scene::Filter filter = filterIn(
        loadBody("<filter id='f' filterUnits='userSpaceOnUse'><feFlood/></filter><g filter='url(#f)'/>"));
    EXPECT_EQ(filter.primitives.size(), 1u);
}

TEST(Filter, ShowsNotItself) {
    const Document loaded = loadBody(
        "<filter id='f'><feImage href='#r'/></filter><rect id='r' width='4' height='4' filter='url(#f)'/>");
    EXPECT_EQ(itemsOf(loaded).size(), 1u);
    EXPECT_EQ(loaded.warnings.size(), 1u);
}

TEST(FilterFunctions, BecomePrimitives) {
    EXPECT_EQ(
        std::get<scene::GaussianBlurFilter>(functionMade("blur(3px)").primitives[0].operation).deviationX, 3);
    const auto shadow = std::get<scene::DropShadowFilter>(
        functionMade("drop-shadow(red 1px 2px 3px)").primitives[0].operation);
    EXPECT_EQ(shadow.dy, 2);
    EXPECT_EQ(shadow.deviationX, 3);
    EXPECT_EQ(shadow.color.r, 1);
    EXPECT_EQ(std::get<scene::DropShadowFilter>(functionMade("drop-shadow(1px 2px)").primitives[0].operation)
                  .color.b,
              1);
    EXPECT_FALSE(functionMade("sepia()").primitives[0].linear);
}

TEST(FilterFunctions, ListsAreGroupsInEachOther) {
    EXPECT_EQ(filtersOf("none"), 0u);
    EXPECT_EQ(filtersOf("blur(1px) sepia(1) opacity(50%)"), 3u);
}

TEST(FilterFunctions, MalformedListsAreNone) {
    for (const char* value : {"blur(-1px)", "blur(5%)", "blur(1px 2px)", "brightness(-1)", "hue-rotate(90)",
                              "hue-rotate(x)", "drop-shadow(1px)", "drop-shadow(1px, 2px)",
                              "drop-shadow(1px red 2px)", "drop-shadow(1px 2px -1px)", "drop-shadow()",
                              "wobble(1)", "blur(1px", "blur(1px) x", "sepia(1) blur(-1px)"})
        EXPECT_EQ(filtersOf(value), 0u) << value;
}

}  // namespace
}  // namespace vtm::svg
