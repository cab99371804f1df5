// Texts of trees, and the trees that are read from them.
#include <gtest/gtest.h>

#include <vtm/image/codec.hpp>
#include <vtm/raster/evaluate.hpp>
#include "api/tests/tree_support.hpp"
#include "conformance/reference/reference.hpp"
#include "tests/test_folder.hpp"

namespace vtm {
namespace {

using scene::Color;

/// Of 8 by 8 units.
Vtm drawn(const std::string& text) { return readText("vtmtree 1 size 8 8 " + text).vtm; }

std::string dumpOf(const Vtm& vtm) { return scene::dump(vtm.toScene(8, 8)); }

TEST(Tree, SelectionsAreThoseOfTheApi) {
    EXPECT_EQ(dumpOf(drawn("draw select \"M0 0H4V4H0Z\" red else blue")),
              dumpOf(Vtm::select(box(4), red, blue)));
    EXPECT_EQ(dumpOf(drawn("shape a = rect(0 0, 4 4) draw select a red")), dumpOf(Vtm::select(box(4), red)));
    EXPECT_EQ(dumpOf(drawn("draw select rect(0 0 4 4) {} else blue")), dumpOf(Vtm::select(box(4), {}, blue)));
}

TEST(Tree, ABlockIsInPaintersOrder) {
    EXPECT_EQ(dumpOf(drawn("draw { blue select rect(0 0, 4 4) red }")),
              dumpOf(Vtm::over(Vtm::select(box(4), red), blue)));
    EXPECT_EQ(drawn("draw {}"), Vtm());
    EXPECT_EQ(dumpOf(drawn("draw { { red } }")), dumpOf(red));
}

TEST(Tree, LayersAreCompositedWithWhatIsBelowThemInTheirBlock) {
    const Compositing how{0.5f, scene::BlendMode::Multiply};
    EXPECT_EQ(dumpOf(drawn("draw { blue layer opacity 0.5 blend multiply red }")),
              dumpOf(Vtm::layer(red, blue, how)));
    EXPECT_EQ(dumpOf(drawn("draw { blue { layer opacity 0.5 blend multiply red } }")),
              dumpOf(Vtm::over(Vtm::layer(red, {}, how), blue)));
}

TEST(Tree, ElseBelongsToTheLastSelection) {
    const Vtm inner = Vtm::select(box(2), red, blue);
    EXPECT_EQ(dumpOf(drawn("draw select rect(0 0 4 4) select rect(0 0 2 2) red else blue")),
              dumpOf(Vtm::select(box(4), inner)));
    EXPECT_EQ(dumpOf(drawn("draw select rect(0 0 4 4) { select rect(0 0 2 2) red } else blue")),
              dumpOf(Vtm::select(box(4), Vtm::select(box(2), red), blue)));
}

TEST(Tree, PlacedMovesThePartBeforeIt) {
    const Vtm sign = Vtm::select(box(4), red);
    EXPECT_EQ(dumpOf(drawn(
                  "vtm sign = select rect(0 0, 4 4) red\n"
                  "draw { sign placed translate(1 2) scale(0.5) sign placed scale(2) placed translate(3) }")),
              dumpOf(Vtm::over(sign.placed(scene::scaling(2, 2)).placed(scene::translation(3, 0)),
                               sign.placed({0.5, 0, 0, 0.5, 1, 2}))));
}

TEST(Tree, ShapesAreFilledStrokedAndPlaced) {
    scene::StrokeStyle pen;
    pen.width = 2;
    pen.cap = scene::Cap::Round;
    pen.join = scene::Join::MiterClip;
    pen.miterLimit = 3;
    pen.dashes = {1, 1};
    pen.dashPhase = 0.5;
    const scene::Path line{scene::MoveTo{{0, 0}}, scene::LineTo{{8, 8}}};
    Mask mask = stroked(line, pen);
    mask.transform = scene::scaling(2, 3);
    EXPECT_EQ(dumpOf(drawn("shape line = \"M0 0 8 8\" shape pen = line stroke 2 cap round join miter-clip "
                           "miter 3 dash(1) phase 0.5 draw select pen placed scale(2 3) red")),
              dumpOf(Vtm::select(mask, red)));
    EXPECT_EQ(dumpOf(drawn("draw select \"M0 0 8 8\" evenodd red")),
              dumpOf(Vtm::select(filled(line, scene::FillRule::EvenOdd), red)));
}

TEST(Tree, CirclesAndRectanglesAreShapes) {
    const auto area = [](const std::string& shape) {
        const scene::Scene scene = drawn("draw select " + shape + " red").toScene(8, 8);
        const image::Raster raster = reference::render(scene, {8, 8, scene::identity});
        double sum = 0;
        for (int i = 0; i < 64; ++i)
            sum += double(raster.pixel(i % 8, i / 8)[3]);
        return sum;
    };
    EXPECT_NEAR(area("circle(4 4 3)"), 28.274, 0.01);
    EXPECT_NEAR(area("rect(1 2, 4 7)"), 15, 0.01);
}

TEST(Tree, ColoursAreThoseOfCss) {
    const auto color = [](const std::string& text) {
        return std::get<Color>(std::get<PaintNode>(drawn("draw " + text).node()->value).paint);
    };
    EXPECT_EQ(color("#f00"), (Color{1, 0, 0, 1}));
    EXPECT_EQ(color("#00ff0080"), (Color{0, 1, 0, float(128 / 255.0)}));
    EXPECT_EQ(color("rgb(0 0 255 / 0.25)"), (Color{0, 0, 1, 0.25f}));
    EXPECT_EQ(color("hsl(120 100% 50%)"), (Color{0, 1, 0, 1}));
    EXPECT_EQ(color("Lime"), (Color{0, 1, 0, 1}));
    EXPECT_EQ(color("color(srgb 0.1 0.2 0.3 / 0.4)"), (Color{0.1f, 0.2f, 0.3f, 0.4f}));
    EXPECT_EQ(std::get<PaintNode>(drawn("draw red opacity 0.5").node()->value).opacity, 0.5f);
}

TEST(Tree, GradientsHaveStopsSpreadsAndTransforms) {
    const std::vector<scene::GradientStop> stops{{0, {1, 0, 0, 1}}, {1, {0, 0, 1, 1}}};
    const scene::LinearGradient linear{{0, 1}, {2, 3}, stops, scene::Spread::Reflect, scene::scaling(2, 2)};
    EXPECT_EQ(dumpOf(drawn("draw linear(0 1, 2 3) reflect transform scale(2) { 0 red, 1 blue }")),
              dumpOf(Vtm::paint(linear)));
    const scene::RadialGradient radial{{4, 4}, 3, {5, 4}, 1, stops};
    EXPECT_EQ(dumpOf(drawn("draw radial(4 4 3) focus(5 4 1) { 0 red 1 blue }")), dumpOf(Vtm::paint(radial)));
}

TEST(Tree, PaintsOverThePlaneFillTheTileOfAPattern) {
    const scene::Scene scene =
        drawn("draw pattern(2 2, 4 4) transform scale(0.5) { lime select rect(2 2, 3 4) red }").toScene(8, 8);
    const image::Raster raster = reference::render(scene, {16, 16, scene::scaling(2, 2)});
    EXPECT_NEAR(raster.pixel(0, 0)[0], 1, 1e-3);
    EXPECT_NEAR(raster.pixel(1, 1)[1], 1, 1e-3);
    EXPECT_NEAR(raster.pixel(6, 9)[0], 1, 1e-3);
}

TEST(Tree, MasksReachAsFarAsThePicture) {
    const scene::Scene scene =
        drawn("draw { layer mask alpha { red opacity 0.5 } blue placed translate(9e5) }").toScene(8, 8);
    EXPECT_NEAR(reference::render(scene, {8, 8, scene::identity}).pixel(7, 7)[3], 0.5, 1e-3);
    const image::Raster raster = asset::evaluate(compiler::compile(scene).asset, {8, 8});
    for (const int at : {0, 7})
        EXPECT_NEAR(raster.pixel(at, at)[3], 0.5, 1e-3);
}

TEST(Tree, ClipsAreUnionsWithinClips) {
    const Vtm vtm = drawn(
        "clip half = { rect(0 0, 4 8) }\n"
        "draw layer clip { rect(0 0, 2 2) rect(0 2, 8 4) within { rect(6 0, 8 8) } circle(1 7 1) } red\n");
    const scene::Scene scene = vtm.toScene(8, 8);
    const image::Raster raster = reference::render(scene, {8, 8, scene::identity});
    EXPECT_NEAR(raster.pixel(1, 1)[3], 1, 1e-3);
    EXPECT_NEAR(raster.pixel(3, 3)[3], 0, 1e-3);
    EXPECT_NEAR(raster.pixel(7, 3)[3], 1, 1e-3);
    EXPECT_NEAR(raster.pixel(7, 7)[3], 0, 1e-3);
    const Vtm cut =
        drawn("clip half = { rect(0 0, 4 8) } draw layer clip { rect(0 0, 8 4) } within half red");
    const image::Raster both = reference::render(cut.toScene(8, 8), {8, 8, scene::identity});
    EXPECT_NEAR(both.pixel(3, 3)[3], 1, 1e-3);
    EXPECT_NEAR(both.pixel(5, 3)[3], 0, 1e-3);
    EXPECT_NEAR(both.pixel(3, 5)[3], 0, 1e-3);
}

TEST(Tree, MaterialsHaveTextsWithEscapes) {
    const Vtm vtm =
        drawn("draw material plain lime \"vec4 plain(vec2 p) { return vec4(1); } // \\\" \\\\\n\"");
    const auto& paint = std::get<scene::Material>(std::get<PaintNode>(vtm.node()->value).paint);
    EXPECT_EQ(paint.name, "plain");
    EXPECT_EQ(paint.glsl, "vec4 plain(vec2 p) { return vec4(1); } // \" \\\n");
    EXPECT_EQ(paint.fallback, (Color{0, 1, 0, 1}));
}

TEST(Tree, ImagesAreReadBelowTheGivenFolderOnly) {
    const image::Bitmap bitmap{1, 1, {9, 8, 7, 255}};
    const TestFolder folder;
    image::writeFile((folder / "dot.png").string(), image::encodePng(bitmap));
    const std::string text = "vtmtree 1 size 8 8 image dot = \"dot.png\" draw image dot nearest";
    const Tree tree = readTree(bytesOf(text), {"t", folder.path().string()});
    const auto& paint = std::get<scene::ImagePaint>(std::get<PaintNode>(tree.vtm.node()->value).paint);
    EXPECT_EQ(paint.bitmap->rgba, bitmap.rgba);
    EXPECT_EQ(paint.filter, scene::ImageFilter::Nearest);
    EXPECT_THROW(readText(text), TreeError);
}

TEST(Tree, ItIsToldFromOtherFilesByItsFirstWord) {
    EXPECT_TRUE(isTree(bytesOf("\xef\xbb\xbf // a comment\n\n vtmtree 1")));
    EXPECT_FALSE(isTree(bytesOf("vtmtrees")));
    EXPECT_FALSE(isTree(bytesOf("<svg/>")));
    EXPECT_FALSE(isTree({}));
}

}  // namespace
}  // namespace vtm
