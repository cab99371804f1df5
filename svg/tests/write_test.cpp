#include <vtm/svg/write.hpp>

#include <cmath>
#include <memory>

#include <vtm/image/codec.hpp>
#include "svg/css/cursor.hpp"
#include "svg/tests/support.hpp"
#include "svg/write/values.hpp"
#include "svg/xml/resource.hpp"

namespace vtm::svg {
namespace {

using scene::Color;
using scene::FillRule;
using scene::Group;
using scene::Item;
using scene::Point;

Group around(std::vector<scene::Node> nodes) {
    Group group;
    group.children = std::move(nodes);
    return group;
}

scene::Scene sceneOf(Group root) { return {30, 20, std::move(root)}; }

std::shared_ptr<const scene::Path> square(double side) {
    return std::make_shared<const scene::Path>(scene::rectangle(Point(0), Point(side)));
}

Item filled(double side, scene::Paint paint) {
    return {square(side), scene::identity, FillRule::NonZero, std::move(paint)};
}

std::shared_ptr<const Group> groupOfItem(Item item) {
    auto group = std::make_shared<Group>();
    group->children.push_back({std::move(item)});
    return group;
}

std::shared_ptr<const image::Bitmap> checks(int width, int height) {
    auto bitmap = std::make_shared<image::Bitmap>();
    bitmap->width = width;
    bitmap->height = height;
    for (int i = 0; i < width * height; ++i)
        for (const int channel : {i * 37 % 256, i * 91 % 256, 200, i % 3 ? 255 : 100})
            bitmap->rgba.push_back(static_cast<std::uint8_t>(channel));
    return bitmap;
}

std::size_t countOf(const std::string& text, std::string_view part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + part.size()))
        ++count;
    return count;
}

constexpr const char* red = "<path d='M1 1H9V9Z' fill='red'/>";
const std::string redAndBlue = std::string(red) + "<path d='M2 2H8V8Z' fill='blue'/>";

/// A copy in which no part has two users. Bitmaps keep theirs.
Group unshared(const Group& group);

scene::Link<Group> unshared(const scene::Link<Group>& group) {
    return group ? std::make_shared<const Group>(unshared(*group)) : nullptr;
}

std::shared_ptr<const scene::Path> unshared(const std::shared_ptr<const scene::Path>& path) {
    return std::make_shared<const scene::Path>(*path);
}

scene::Link<scene::Clip> unshared(const scene::Link<scene::Clip>& clip) {
    if (!clip)
        return nullptr;
    auto copy = std::make_shared<scene::Clip>(*clip);
    copy->clip = unshared(copy->clip);
    for (scene::ClipShape& shape : copy->shapes) {
        shape.path = unshared(shape.path);
        shape.clip = unshared(shape.clip);
    }
    return copy;
}

Item unshared(Item item) {
    item.path = unshared(item.path);
    if (auto* pattern = std::get_if<scene::Pattern>(&item.paint))
        pattern->content = unshared(pattern->content);
    return item;
}

Group unshared(const Group& group) {
    Group copy = group;
    copy.clip = unshared(copy.clip);
    if (copy.mask)
        copy.mask = std::make_shared<const scene::Mask>(
            scene::Mask{unshared(copy.mask->content), copy.mask->kind, copy.mask->linear});
    for (scene::Node& node : copy.children)
        if (auto* item = std::get_if<Item>(&node.value))
            *item = unshared(*item);
        else if (auto* child = std::get_if<Group>(&node.value))
            *child = unshared(*child);
    return copy;
}

scene::Scene unshared(const scene::Scene& scene) { return {scene.width, scene.height, unshared(scene.root)}; }

/// The same tree of nodes with the same values, written and read again without a warning.
void expectSameScene(const scene::Scene& once) {
    const std::string text = write(once);
    const Document twice = loadText(text);
    EXPECT_EQ(dump(unshared(twice.scene)), dump(unshared(once))) << text;
    EXPECT_TRUE(twice.warnings.empty()) << twice.warnings.front().message << "\n" << text;
    EXPECT_EQ(write(twice.scene), text);
}

void expectSame(const std::string& body) {
    const Document once = loadBody(body);
    ASSERT_FALSE(once.scene.root.children.empty()) << body;
    expectSameScene(once.scene);
}

std::string written(const std::string& body) { return write(loadBody(body).scene); }

TEST(Write, PathsOfAllCommands) {
    expectSame("<path d='M1.25 2L3 0.1Q5 6 7 8C1 2 3 4 5.5 6.125A3 4 90 1 0 9 10ZL3 3' fill='#123456'/>");
}

TEST(Write, FillRulesAndOpacities) {
    expectSame("<path d='M1 1H9V9H1Z' fill='#abcdef' fill-opacity='0.5' fill-rule='evenodd'/>");
    expectSame("<g opacity='0.25'>" + redAndBlue + "</g>");
}

TEST(Write, Strokes) {
    expectSame(
        "<path d='M1 1H9V9' fill='none' stroke='#080' stroke-width='0.75' stroke-linecap='round' "
        "stroke-linejoin='bevel' stroke-dasharray='3 1 2 1' stroke-dashoffset='0.5'/>");
    expectSame(
        "<path d='M1 1H9V9' fill='none' stroke='#080' stroke-linejoin='miter-clip' stroke-miterlimit='7'/>");
    expectSame(
        "<path d='M1 1H9V9' fill='none' stroke='red' stroke-linecap='square' stroke-linejoin='round'/>");
}

TEST(Write, Transforms) {
    expectSame("<path d='M1 1H9V9Z' transform='matrix(1 2 3 0.5 -1 4)'/>");
    expectSame("<path d='M1 1H9V9Z' transform='translate(0.1 -1e-7)'/>");
    expectSame("<path d='M1e-9 0H9e-9V5e-9Z' transform='scale(1e9)'/>");
}

TEST(Write, FillAndStrokeAreOneElement) {
    const std::string body =
        "<path d='M1 1H9V9Z' fill='red' stroke='url(#g)' fill-opacity='0.5'/>"
        "<linearGradient id='g'><stop/><stop offset='1'/></linearGradient>";
    expectSame(body);
    EXPECT_EQ(countOf(written(body), "<path"), 1u);
    const std::string strokeFirst = "<path d='M1 1H9V9Z' fill='red' stroke='blue' paint-order='stroke'/>";
    expectSame(strokeFirst);
    EXPECT_EQ(countOf(written(strokeFirst), "<path"), 1u);
}

TEST(Write, Gradients) {
    const std::string stops =
        "<stop offset='0.1' stop-color='red' stop-opacity='0.3'/><stop offset='0.1' stop-color='#123'/>"
        "<stop offset='0.9'/>";
    expectSame(
        "<linearGradient id='g' x1='0.1' y2='0.7' spreadMethod='reflect' gradientTransform='skewX(20)'>" +
        stops + "</linearGradient><path d='M1 1H9V8Z' fill='url(#g)' stroke='url(#g)'/>");
    expectSame("<radialGradient id='g' fx='0.4' fy='0.3' fr='0.1' spreadMethod='repeat'>" + stops +
               "</radialGradient><path d='M1 1H9V8Z' fill='url(#g)' fill-opacity='0.5'/>");
    expectSame("<radialGradient id='g' cx='4' cy='5' r='3' gradientUnits='userSpaceOnUse'>" + stops +
               "</radialGradient><path d='M1 1H9V8Z' fill='none' stroke='url(#g)' stroke-opacity='0.5'/>");
}

TEST(Write, FocusOnTheEndCircleStaysWhereItIs) {
    for (const char* focus : {"fx='0.9' fy='0.9'", "fx='1' fr='0.2'", "fx='0.99' fy='0.4' fr='0.3'"})
        expectSame("<radialGradient id='g' " + std::string(focus) +
                   "><stop stop-color='red'/><stop offset='1'/></radialGradient>"
                   "<path d='M1 1H9V8Z' fill='url(#g)' transform='rotate(17)'/>");
}

TEST(Write, EqualGradientsAreOne) {
    const std::string text = written(
        "<linearGradient id='g' gradientUnits='userSpaceOnUse'><stop/><stop offset='1'/>"
        "</linearGradient><g fill='url(#g)'><path d='M1 1H9V8Z'/><path d='M1 1H9V7Z'/></g>");
    EXPECT_EQ(countOf(text, "<linearGradient"), 1u) << text;
}

TEST(Write, Patterns) {
    expectSame("<pattern id='p' width='4' height='3' patternUnits='userSpaceOnUse'>" + std::string(red) +
               "</pattern><path d='M1 1H29V18Z' fill='url(#p)'/>");
    expectSame("<pattern id='p' x='0.1' y='0.7' width='0.3' height='0.2' patternTransform='rotate(33)'>" +
               redAndBlue + "</pattern><path d='M1 1H29V18Z' stroke='url(#p)' transform='skewY(5)'/>");
    expectSame(
        "<pattern id='p' x='3' y='1' width='7' height='5' patternUnits='userSpaceOnUse' "
        "viewBox='-2.5 1.3 9 9'>" +
        redAndBlue + "</pattern><path d='M1 1H29V18Z' fill='url(#p)'/>");
    expectSame("<pattern id='q' width='2' height='2' patternUnits='userSpaceOnUse'>" + std::string(red) +
               "</pattern><pattern id='p' width='9' height='9' patternUnits='userSpaceOnUse'>"
               "<g opacity='0.5'><path d='M0 0H6V6Z' fill='url(#q)'/>" +
               red + "</g></pattern><path d='M1 1H29V18Z' fill='url(#p)'/>");
}

TEST(Write, Clips) {
    expectSame(
        "<clipPath id='c'><path d='M0 0H5V7Z' clip-rule='evenodd'/>"
        "<circle r='3' transform='translate(1 2)'/></clipPath><g clip-path='url(#c)'>" +
        redAndBlue + "</g>");
    expectSame("<clipPath id='c'/><g clip-path='url(#c)'>" + redAndBlue + "</g>");
}

TEST(Write, ClipsOfClips) {
    const std::string inner = "<clipPath id='i'><path d='M0 0H4V4Z' transform='scale(2)'/></clipPath>";
    expectSame(
        inner +
        "<clipPath id='c' clip-path='url(#i)'><path d='M0 0H5V7Z'/></clipPath><g clip-path='url(#c)'>" + red +
        "</g>");
    for (const char* place : {"", " transform='rotate(30)'", " transform='rotate(30)' clip-rule='evenodd'"})
        expectSame(inner + "<clipPath id='c'><path d='M0 0H5V7Z' clip-path='url(#i)'" + place +
                   "/></clipPath><g clip-path='url(#c)'>" + red + "</g>");
}

TEST(Write, Masks) {
    for (const char* attributes : {"", "mask-type='alpha'", "color-interpolation='linearRGB'",
                                   "maskUnits='userSpaceOnUse' x='2.3' y='3.1' width='2' height='1'"})
        expectSame("<mask id='m' " + std::string(attributes) + ">" + redAndBlue +
                   "</mask><g mask='url(#m)'>" + red + "</g>");
    expectSame("<mask id='m'/><g mask='url(#m)'>" + std::string(red) + "</g>");
}

TEST(Write, MasksOfMasks) {
    expectSame(
        "<mask id='i'><path d='M0 0H30V20Z' fill='#888'/></mask>"
        "<mask id='m' mask='url(#i)'>" +
        redAndBlue + "<g mask='url(#i)'>" + redAndBlue + "</g></mask><g mask='url(#m)'>" + red + "</g>");
}

TEST(Write, MasksWithOpacity) {
    Group content = around({{filled(9, Color{1, 1, 1, 1})}, {filled(5, Color{1, 0, 0, 1})}});
    content.opacity = 0.5f;
    auto mask = std::make_shared<scene::Mask>();
    mask->content = std::make_shared<const Group>(content);
    Group masked = around({{filled(9, Color{1, 0, 0, 1})}});
    masked.mask = mask;
    const scene::Scene again = loadText(write(sceneOf(around({{masked}})))).scene;
    const auto& group = std::get<Group>(again.root.children.at(0).value);
    const auto& inner = std::get<Group>(group.mask->content->children.at(0).value);
    EXPECT_EQ(inner.opacity, 0.5f);
    EXPECT_EQ(inner.children.size(), 2u);
}

TEST(Write, BlendModesAndIsolation) {
    for (const char* mode : {"multiply", "screen", "overlay", "darken", "lighten", "color-dodge",
                             "color-burn", "hard-light", "soft-light", "difference", "exclusion", "hue",
                             "saturation", "color", "luminosity", "plus-lighter"})
        expectSame(std::string(red) + "<g style='mix-blend-mode:" + mode + "'>" + redAndBlue + "</g>");
    expectSame(std::string(red) + "<g style='isolation:isolate'>" + red +
               "<g style='mix-blend-mode:screen'>" + red + "</g></g>");
    expectSame(std::string(red) + "<g opacity='0.5' style='mix-blend-mode:hue'>" + redAndBlue + "</g>");
}

TEST(Write, Images) {
    scene::Scene scene = sceneOf({});
    const auto bitmap = checks(4, 3);
    for (const auto filter :
         {scene::ImageFilter::Trilinear, scene::ImageFilter::Nearest, scene::ImageFilter::Bicubic}) {
        Item item = filled(0, scene::ImagePaint{bitmap, filter});
        item.path = std::make_shared<const scene::Path>(scene::rectangle(Point(0), Point(4, 3)));
        item.transform = {2, 1, 0, 3, 5, 6};
        item.opacity = 0.5f;
        scene.root.children.push_back({item});
    }
    expectSameScene(scene);
    const Document read = loadText(write(scene));
    const auto items = itemsOf(read);
    ASSERT_EQ(items.size(), 3u);
    EXPECT_EQ(std::get<scene::ImagePaint>(items[1].paint).bitmap->rgba, bitmap->rgba);
    EXPECT_EQ(countOf(write(scene), "data:image/png"), 1u);
}

/// A bitmap whose outline is not its own is an image that is cut.
TEST(Write, PartsOfImages) {
    Item item = filled(2, scene::ImagePaint{checks(4, 3)});
    item.transform = {2, 1, 0, 3, 5, 6};
    const std::string part = write(sceneOf(around({{item}})));
    EXPECT_NE(part.find("M-1 -1L2 -1L2 2L-1 2Z"), part.npos)
        << part;  // its sides on the border are moved out
    expectSameScene(loadText(part).scene);
    scene::StrokeStyle thin;
    thin.width = 0.5;
    thin.join = scene::Join::Round;
    item.geometry = thin;
    std::get<scene::ImagePaint>(item.paint).transform = {1, 0, 0, 1, -1, -0.5};
    const std::string stroked = write(sceneOf(around({{item}})));
    EXPECT_NE(stroked.find("mask-type=\"alpha\""), stroked.npos) << stroked;
    expectSameScene(loadText(stroked).scene);
}

std::string imageElement(const std::string& attributes) {
    return "<image " + attributes + " href='" + dataUrl("image/png", image::encodePng(*checks(7, 3))) + "'/>";
}

/// As far as rounding lets it.
TEST(Write, OutlinesOfScaledImagesEndWithThem) {
    for (const double scale : {0.1, 1 / 3.0, 1.7, 12345.678}) {
        scene::ImagePaint paint{checks(7, 3)};
        paint.transform = {scale, 0, 0, scale, 0.1, 0.7};
        Item item = filled(0, paint);
        item.path = std::make_shared<const scene::Path>(
            scene::rectangle(Point(0.1, 0.7), Point(0.1, 0.7) + scale * Point(7, 3)));
        expectSameScene(loadText(write(sceneOf(around({{item}})))).scene);
    }
}

TEST(Write, ImagesInTheirViewports) {
    const std::string whole =
        written(imageElement("x='0.1' y='1' width='31.7' height='9' transform='rotate(7)'"));
    EXPECT_EQ(countOf(whole, "clip-path"), 0u) << whole;
    for (const char* attributes : {"x='0.1' y='1' width='31.7' height='9' transform='rotate(7)'",
                                   "x='0.1' width='9' height='31' opacity='0.3' preserveAspectRatio='none'",
                                   "width='30' height='0.7' image-rendering='optimizeSpeed'"})
        expectSame(imageElement(attributes));
}

/// A group round them, of which the first reading has no need, cuts them.
TEST(Write, SlicedImagesAreCutAlongOneAxis) {
    for (const char* attributes :
         {"width='9' height='7' preserveAspectRatio='xMidYMid slice'",
          "x='0.1' y='0.3' width='31.7' height='3.3' preserveAspectRatio='xMinYMax slice'"}) {
        const Document once = loadBody(imageElement(attributes));
        const scene::Path& path = *itemsOf(once).at(0).path;
        const Point min = scene::endOf(path[0]).value(), max = scene::endOf(path[2]).value();
        const bool fullX = min.x == 0 && max.x == 7, fullY = min.y == 0 && max.y == 3;
        EXPECT_NE(fullX, fullY) << attributes;
        expectSameScene(loadText(write(once.scene)).scene);
    }
}

TEST(Write, RepeatedPathsAreWrittenOnce) {
    const std::string path = "M1 1C2 3 4 5 6 7C3 1 4 1 5 9C2 6 5 3 5 8Z";
    std::string body;
    for (int i = 0; i < 3; ++i)
        body += "<path d='" + path + "' transform='translate(" + std::to_string(i) + ")'/>";
    body += "<clipPath id='c'><path d='" + path +
            "' clip-rule='evenodd'/></clipPath><g clip-path='url(#c)'>" + redAndBlue + "</g>";
    expectSame(body);
    EXPECT_EQ(countOf(written(body), "C2 3 4 5 6 7"), 1u) << written(body);
    EXPECT_EQ(countOf(write(loadBody(body).scene, {.shared = false}), "C2 3 4 5 6 7"), 4u);
    expectSame("<path d='M1 1H9V9Z'/><path d='M1 1H9V9Z' transform='translate(1)'/>");
    EXPECT_EQ(countOf(written("<path d='M1 1H3V4'/><path d='M1 1H3V4' transform='translate(1)'/>"), "<use"),
              0u);
}

TEST(Write, TextBecomesOutlines) {
    expectSame("<text x='2' y='15' font-size='9' stroke='red' stroke-width='0.1'>Banana</text>");
    EXPECT_EQ(written("<text x='2' y='15'>Banana</text>").find("<text"), std::string::npos);
}

TEST(Write, WhatPaintsNothingIsLeftOut) {
    Item clear = filled(5, Color{1, 0, 0, 0}), flat = filled(5, Color{}), none = filled(5, Color{});
    flat.transform = scene::scaling(0, 1);
    none.opacity = 0;
    Item tiled = filled(5, scene::Pattern{Point(0), Point(2), groupOfItem(clear)});
    Group hidden = around({{filled(5, Color{})}, {filled(4, Color{})}});
    hidden.opacity = 0;
    const std::string text = write(sceneOf(around({{clear}, {flat}, {none}, {tiled}, {hidden}, {Group{}}})));
    EXPECT_EQ(countOf(text, "<"), 2u) << text;
}

TEST(Write, PartOfAPicture) {
    const Document once = loadBody(red);
    const Document part = loadText(write(once.scene, {.part = scene::Rect{2, 3, 4.5, 6}}));
    EXPECT_EQ(part.scene.width, 4.5);
    EXPECT_EQ(part.scene.height, 6);
    EXPECT_EQ(itemsOf(part).at(0).transform, scene::translation(-2, -3));
}

TEST(Write, SizesAreExact) {
    for (const double side : {0x1p-40, 0.1, 1 / 3.0, 123456.789, 1e9}) {
        scene::Scene scene = sceneOf(around({{filled(5, Color{})}}));
        scene.width = side;
        const scene::Scene again = loadText(write(scene)).scene;
        EXPECT_EQ(again.width, side);
        EXPECT_EQ(itemsOf({again, {}, {}}).at(0).transform, scene::identity);
    }
}

TEST(Write, NumbersReadBackExactly) {
    for (const double value :
         {0.0, 0.1, -1 / 3.0, 1e-300, 5e-324, 123456789.123456789, 1e30, 1e16, -0x1.fffffffffffffp-30})
        EXPECT_EQ(Cursor(number(value)).number(), value) << number(value);
    EXPECT_EQ(number(-0.0), "0");
    EXPECT_EQ(number(0.1f), "0.1");
    EXPECT_THROW(number(1.1e30), WriteError);
}

void expectRefused(Item item, std::string_view reason) {
    try {
        write(sceneOf(around({{std::move(item)}})));
        ADD_FAILURE() << "no error: " << reason;
    } catch (const WriteError& error) {
        EXPECT_NE(std::string_view(error.what()).find(reason), std::string_view::npos) << error.what();
    }
}

TEST(Write, SaysWhatSvgCannotSay) {
    expectRefused(filled(5, scene::Material{"wood", "vec4 wood(vec2 p) { return vec4(p, 0, 1); }", {}}),
                  "'wood'");
    expectRefused(filled(2, scene::ImagePaint{checks(4, 3), scene::ImageFilter::Bilinear}), "bilinear");
    expectRefused(filled(3.5, scene::ImagePaint{checks(4, 3)}), "reaches beyond the image");
    Item huge = filled(2, Color{});
    huge.transform = scene::scaling(1e200, 1e200);
    expectRefused(huge, "1e+200");
}

TEST(Write, SharedGroupsDoNotMultiply) {
    auto group = groupOfItem(filled(9, Color{1, 0, 0, 1}));
    for (int i = 0; i < 100; ++i) {
        auto next = std::make_shared<Group>();
        next->children.push_back(
            {scene::Select{{square(i), scene::identity, FillRule::NonZero}, group, group}});
        group = next;
    }
    EXPECT_LT(write(sceneOf(*group)).size(), 100000u);
}

TEST(Write, AnglesReadBackExactly) {
    for (const double degrees : {30.0, 45.0, 0.1, -77.7, 359.999, 1e-7, 123456.789, 1 / 3.0})
        expectSame("<path d='M1 1A5 3 " + std::to_string(degrees) + " 0 1 9 9Z'/>");
    const std::string text = written("<path d='M1 1A5 3 30 0 1 9 9Z'/>");
    EXPECT_NE(text.find("A5 3 30 0 1 9 9"), text.npos) << text;
}

}  // namespace
}  // namespace vtm::svg
