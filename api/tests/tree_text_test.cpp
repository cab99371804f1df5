// Trees as texts, which read back as the same trees.
#include <gtest/gtest.h>

#include <cmath>

#include <vtm/image/codec.hpp>
#include <vtm/svg/load.hpp>
#include "api/tests/tree_support.hpp"

namespace vtm {
namespace {

using scene::Color;

/// Writes, reads, compares and writes again. Returns the text.
std::string checked(const Vtm& vtm) {
    const Tree tree{8, 8, vtm};
    const std::string text = writeTree(tree);
    const Tree back = readText(text);
    EXPECT_EQ(scene::dump(back.toScene()), scene::dump(tree.toScene())) << text;
    EXPECT_EQ(writeTree(back), text);
    return text;
}

std::string drawnBack(const Vtm& vtm) {
    const std::string text = checked(vtm);
    return text.substr(text.find("\n\n") + 2);
}

TEST(TreeText, IsTheShortestThatMeansTheTree) {
    const Vtm sign = Vtm::select(box(4), red, blue);
    EXPECT_EQ(drawnBack({}), "draw {}\n");
    EXPECT_EQ(drawnBack(sign), "draw select \"M0 0L4 0L4 4L0 4Z\" #ff0000 else #0000ff\n");
    EXPECT_EQ(drawnBack(sign.placed(scene::translation(1, 2))),
              "draw { select \"M0 0L4 0L4 4L0 4Z\" #ff0000 else #0000ff } placed translate(1 2)\n");
    EXPECT_EQ(drawnBack(Vtm::over(sign, Vtm::paint(Color{0, 1, 0, 1}))),
              "draw {\n    #00ff00\n    select \"M0 0L4 0L4 4L0 4Z\" #ff0000 else #0000ff\n}\n");
    EXPECT_EQ(drawnBack(Vtm::layer(red, blue, {0.5f})),
              "draw {\n    #0000ff\n    layer opacity 0.5 #ff0000\n}\n");
}

TEST(TreeText, WritesWhatOccursTwiceOnce) {
    const Vtm sign = Vtm::select(box(4), red, blue);
    EXPECT_EQ(drawnBack(Vtm::over(sign.placed(scene::scaling(2, 2)), sign)),
              "vtm v1 = select \"M0 0L4 0L4 4L0 4Z\" #ff0000 else #0000ff\n"
              "draw {\n    v1\n    v1 placed scale(2)\n}\n");
    EXPECT_EQ(drawnBack(Vtm::over(red, red)), "vtm v1 = #ff0000\ndraw {\n    v1\n    v1\n}\n");
    const Mask mask = box(4);
    EXPECT_EQ(drawnBack(Vtm::select(mask, red, Vtm::select(mask, blue))),
              "shape s1 = \"M0 0L4 0L4 4L0 4Z\"\ndraw select s1 #ff0000 else select s1 #0000ff\n");
}

TEST(TreeText, IsolatesLayersThatAreAlone) {
    const Vtm multiplied = Vtm::layer(red, {}, {1, scene::BlendMode::Multiply});
    checked(Vtm::over(multiplied, blue));
    checked(Vtm::select(box(4), multiplied, blue));
    checked(Vtm::over(Vtm::over(red, blue), blue));
    checked(Vtm::layer(multiplied, blue, {0.5f}));
    checked(Vtm::select(box(4), Vtm::select(box(2), red), blue));
}

TEST(TreeText, HasEveryKindOfPaint) {
    const std::vector<scene::GradientStop> stops{{0, {1, 0, 0, 0.3f}}, {0.1f, {0.1f, 0.2f, 0.3f, 1}}};
    const scene::Affine turn{0.1, 1.0 / 3, -7, 1e-9, 12345.678, -0.0};
    const image::Bitmap bitmap{1, 2, {1, 2, 3, 4, 5, 6, 7, 255}};
    const auto shared = std::make_shared<const image::Bitmap>(bitmap);
    const auto group = std::make_shared<const scene::Group>(Vtm::select(box(4), red).toScene(8, 8).root);
    const scene::Paint paints[] = {
        Color{0.1f, 0.2f, 0.3f, 0.4f},
        scene::LinearGradient{{0, 1}, {2, 3}, stops, scene::Spread::Repeat, turn},
        scene::RadialGradient{{4, 4}, 3, {5, 4}, 1, stops, scene::Spread::Reflect, turn},
        scene::Pattern{{-1, 0.1}, {4, 4}, group, turn},
        scene::ImagePaint{shared, scene::ImageFilter::Bicubic, turn},
        scene::ImagePaint{shared, scene::ImageFilter::Trilinear, scene::identity},
        scene::Material{"plain", "// \"quoted\" \\ \nvec4 plain(vec2 p) {}", {0, 1, 0, 1}, turn}};
    Vtm all = red;
    for (const scene::Paint& paint : paints)
        all = Vtm::over(Vtm::select(box(4), Vtm::paint(paint, 0.7f)), all);
    EXPECT_NE(checked(all).find("image i1 = "), std::string::npos);
}

TEST(TreeText, HasClipsAndMasks) {
    const auto path = std::make_shared<const scene::Path>(scene::rectangle({0, 0}, {4, 4}));
    const auto inner = std::make_shared<const scene::Clip>(
        scene::Clip{{{path, scene::scaling(2, 1), scene::FillRule::EvenOdd, nullptr}}, nullptr});
    const auto clip = std::make_shared<const scene::Clip>(
        scene::Clip{{{path, scene::identity, scene::FillRule::NonZero, inner}}, inner});
    const auto group = std::make_shared<const scene::Group>(Vtm::select(box(4), red).toScene(8, 8).root);
    for (const scene::Mask& mask : {scene::Mask{group}, scene::Mask{group, scene::MaskKind::Alpha},
                                    scene::Mask{group, scene::MaskKind::Luminance, true}}) {
        const auto shared = std::make_shared<const scene::Mask>(mask);
        checked(Vtm::layer(red, Vtm::layer(blue, {}, {1, {}, clip, shared}), {0.5f, {}, clip, shared}));
    }
}

TEST(TreeText, PatternsOfSeveralTilesShareTheirContent) {
    const auto item = std::make_shared<const scene::Group>(Vtm::select(box(4), red).toScene(8, 8).root);
    const auto paint =
        std::make_shared<const scene::Group>(Vtm::over(Vtm::select(box(2), red), blue).toScene(1, 1).root);
    for (const auto& content : {item, paint}) {
        const Vtm small = Vtm::paint(scene::Pattern{{0, 0}, {1, 1}, content});
        const Vtm large = Vtm::paint(scene::Pattern{{0, 0}, {2, 1}, content});
        checked(Vtm::select(box(4), small, large));
    }
    const std::string text =
        "vtmtree 1 size 8 8 vtm a = { red select rect(0 0 1 1) blue } "
        "draw { pattern(0 0 1 1) { a } pattern(0 0 2 2) { a } pattern(0 0 1 1) { a } }";
    checked(readText(text).vtm);
}

TEST(TreeText, DeepTreesAreCutIntoNamedParts) {
    Vtm inside = red, outside = red, layers = red, chain = red, placed = red;
    for (int i = 0; i < 300; ++i) {
        inside = Vtm::select(box(4), inside, blue);
        outside = Vtm::select(box(4), blue, outside);
        layers = Vtm::layer(layers, blue, {0.5f});
        placed = Vtm::select(box(4), placed).placed(scene::translation(0.5, 0));
    }
    for (int i = 0; i < 3000; ++i)
        chain = Vtm::select(box(4), Vtm::over(blue, chain), chain);
    for (const Vtm& vtm : {inside, outside, layers, placed})
        EXPECT_NE(checked(vtm).find("vtm v4"), std::string::npos);
    EXPECT_EQ(checked(chain).find("vtm v2"), std::string::npos);
}

TEST(TreeText, SharedPartsTakeNoExponentialTime) {
    Vtm part = Vtm::select(box(4), red);
    for (int i = 0; i < 60; ++i)
        part = Vtm::select(box(i), Vtm::layer(part, {}, {0.5f}), part);
    EXPECT_LT(writeTree({8, 8, part}).size(), 10'000u);
}

TEST(TreeText, ManyLevelsTakeNoStack) {
    Vtm inside = red, layers = red;
    for (int i = 0; i < 200'000; ++i) {
        inside = Vtm::select(box(1), inside, blue);
        layers = Vtm::layer(layers, blue, {0.5f});
    }
    EXPECT_GT(writeTree({8, 8, inside}).size(), 200'000u);
    EXPECT_GT(writeTree({8, 8, layers}).size(), 200'000u);
}

TEST(TreeText, NumbersThatCannotBeReadAreErrors) {
    for (const double bad : {1e31, HUGE_VAL, std::nan("")})
        EXPECT_THROW(writeTree({8, 8, Vtm::select(box(bad), red)}), TreeError);
}

class TreeOfExample : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(TreeText, TreeOfExample,
                         testing::Values("lighthouse", "rose_window", "gauge", "planet", "blend", "tiles",
                                         "type"),
                         [](const auto& tested) { return std::string(tested.param); });

TEST_P(TreeOfExample, ReadsBackAsTheSameScene) {
    const std::string path = std::string(VTM_SOURCE_DIR) + "/examples/" + GetParam() + ".svg";
    const scene::Scene scene = svg::load(image::readFile(path)).scene;
    const Tree tree{scene.width, scene.height, Vtm::fromScene(scene)};
    const std::string text = writeTree(tree);
    const Tree back = readText(text);
    EXPECT_EQ(scene::dump(back.toScene()), scene::dump(scene));
    EXPECT_EQ(writeTree(back), text);
}

}  // namespace
}  // namespace vtm
