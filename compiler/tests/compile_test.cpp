#include <vtm/compiler/compile.hpp>
#include <vtm/compiler/session.hpp>

#include <bit>

#include <gtest/gtest.h>

#include <vtm/asset/container.hpp>
#include <vtm/raster/evaluate.hpp>

namespace vtm::compiler {
namespace {

using scene::Color;
using scene::Group;
using scene::Item;
using scene::Node;
using scene::Path;
using scene::Point;

constexpr Color red{1, 0, 0, 1}, green{0, 1, 0, 1}, blue{0, 0, 1, 1}, white{1, 1, 1, 1}, black{0, 0, 0, 1};

Item rect(Point min, Point max, scene::Paint paint) {
    Item item;
    item.path = std::make_shared<Path>(scene::rectangle(min, max));
    item.geometry = scene::FillRule::NonZero;
    item.paint = std::move(paint);
    return item;
}

Group group(std::vector<Item> items) {
    Group g;
    for (Item& item : items)
        g.children.push_back({std::move(item)});
    return g;
}

scene::Scene picture(Group root, double width = 64, double height = 64) {
    return {width, height, std::move(root)};
}

/// The pixel at (x, y) of the picture drawn one unit a pixel.
std::array<float, 4> pixel(const scene::Scene& scene, int x, int y, asset::Mode mode = asset::Mode::Exact) {
    Options options;
    options.mode = mode;
    const asset::Asset asset = compile(scene, options).asset;
    asset::validate(asset);
    asset::View view{static_cast<int>(scene.width), static_cast<int>(scene.height)};
    const image::Raster raster = asset::evaluate(asset, view);
    std::array<float, 4> p;
    std::copy_n(raster.pixel(x, y), 4, p.begin());
    return p;
}

void expectNear(const std::array<float, 4>& a, const std::array<float, 4>& b, float by = 1e-3f) {
    for (std::size_t c = 0; c < 4; ++c)
        EXPECT_NEAR(a[c], b[c], by) << "channel " << c;
}

class BothModes : public testing::TestWithParam<asset::Mode> {};
INSTANTIATE_TEST_SUITE_P(Modes, BothModes, testing::Values(asset::Mode::Exact, asset::Mode::Compat),
                         [](const auto& mode) {
                             return mode.param == asset::Mode::Exact ? "exact" : "compat";
                         });

TEST_P(BothModes, laterItemsLieOnTop) {
    const auto s = picture(group({rect({0, 0}, {64, 64}, red), rect({10, 10}, {50, 50}, blue)}));
    expectNear(pixel(s, 5, 5, GetParam()), {1, 0, 0, 1});
    expectNear(pixel(s, 30, 30, GetParam()), {0, 0, 1, 1});
}

TEST_P(BothModes, translucentLayersComposite) {
    const auto s =
        picture(group({rect({0, 0}, {64, 64}, red), rect({0, 0}, {64, 64}, Color{0, 0, 1, 0.25f})}));
    expectNear(pixel(s, 20, 20, GetParam()), {0.75f, 0, 0.25f, 1});
}

TEST_P(BothModes, aGroupsOpacityCountsOnce) {
    Group g = group({rect({0, 0}, {40, 64}, green), rect({10, 0}, {64, 64}, green)});
    g.opacity = 0.5f;
    Group root = group({rect({0, 0}, {64, 64}, red)});
    root.children.push_back({g});
    const auto s = picture(root);
    expectNear(pixel(s, 20, 20, GetParam()), {0.5f, 0.5f, 0, 1});
    expectNear(pixel(s, 5, 20, GetParam()), {0.5f, 0.5f, 0, 1});
}

TEST_P(BothModes, clipsCut) {
    Group g = group({rect({0, 0}, {64, 64}, green)});
    auto clip = std::make_shared<scene::Clip>();
    clip->shapes.push_back({std::make_shared<Path>(scene::rectangle({10, 10}, {30, 30})), scene::identity,
                            scene::FillRule::NonZero, nullptr});
    clip->shapes.push_back({std::make_shared<Path>(scene::rectangle({40, 10}, {50, 30})), scene::identity,
                            scene::FillRule::NonZero, nullptr});
    g.clip = clip;
    Group root;
    root.children.push_back({g});
    const auto s = picture(root);
    expectNear(pixel(s, 20, 20, GetParam()), {0, 1, 0, 1});
    expectNear(pixel(s, 45, 20, GetParam()), {0, 1, 0, 1});
    expectNear(pixel(s, 35, 20, GetParam()), {0, 0, 0, 0});
}

TEST_P(BothModes, anEmptyClipCutsAll) {
    Group g = group({rect({0, 0}, {64, 64}, green)});
    g.clip = std::make_shared<scene::Clip>();
    Group root;
    root.children.push_back({g});
    expectNear(pixel(picture(root), 20, 20, GetParam()), {0, 0, 0, 0});
}

TEST_P(BothModes, masksMultiply) {
    Group g = group({rect({0, 0}, {64, 64}, green)});
    auto mask = std::make_shared<scene::Mask>();
    mask->content = std::make_shared<Group>(
        group({rect({0, 0}, {32, 64}, Color{1, 1, 1, 0.5f}), rect({0, 0}, {16, 64}, black)}));
    g.mask = mask;
    Group root;
    root.children.push_back({g});
    const auto s = picture(root);
    expectNear(pixel(s, 24, 20, GetParam()), {0, 0.5f, 0, 0.5f});
    expectNear(pixel(s, 8, 20, GetParam()), {0, 0, 0, 0});
    expectNear(pixel(s, 50, 20, GetParam()), {0, 0, 0, 0});
}

TEST_P(BothModes, aMaskWithoutContentHidesAll) {
    Group g = group({rect({0, 0}, {64, 64}, green)});
    auto mask = std::make_shared<scene::Mask>();
    mask->content = std::make_shared<Group>();
    g.mask = mask;
    Group root;
    root.children.push_back({g});
    expectNear(pixel(picture(root), 20, 20, GetParam()), {0, 0, 0, 0});
}

TEST_P(BothModes, theRootMayBeMaskedToo) {
    Group root = group({rect({0, 0}, {64, 64}, green)});
    auto mask = std::make_shared<scene::Mask>();
    mask->kind = scene::MaskKind::Alpha;
    mask->content = std::make_shared<Group>(group({rect({0, 0}, {32, 64}, Color{0, 0, 0, 0.5f})}));
    root.mask = mask;
    const auto s = picture(root);
    expectNear(pixel(s, 20, 20, GetParam()), {0, 0.5f, 0, 0.5f});
    expectNear(pixel(s, 40, 20, GetParam()), {0, 0, 0, 0});
}

TEST_P(BothModes, blendModesSeeWhatLiesBelow) {
    Group g = group({rect({0, 0}, {64, 64}, Color{0.5f, 1, 0.5f, 1})});
    g.blend = scene::BlendMode::Multiply;
    Group root = group({rect({0, 0}, {64, 64}, Color{1, 0.5f, 0.5f, 1})});
    root.children.push_back({g});
    expectNear(pixel(picture(root), 20, 20, GetParam()), {0.5f, 0.5f, 0.25f, 1});
}

TEST(Compile, coloursThatAreBlendedOrMaskedAreColours) {
    Group blended = group({rect({0, 0}, {40, 40}, Color{0.5f, 1, 0.5f, 0.5f})});
    blended.blend = scene::BlendMode::Multiply;
    Group masked = group({rect({20, 20}, {64, 64}, green)});
    auto mask = std::make_shared<scene::Mask>();
    mask->linear = true;
    mask->content = std::make_shared<Group>(group({rect({20, 20}, {50, 50}, Color{0.5f, 1, 0.5f, 1})}));
    masked.mask = mask;
    Group root = group({rect({0, 0}, {64, 64}, Color{1, 0.5f, 0.5f, 1})});
    root.children.push_back({blended});
    root.children.push_back({masked});
    for (const asset::Paint& paint : compile(picture(root)).asset.paints)
        EXPECT_FALSE(asset::isProgram(paint));
}

TEST_P(BothModes, blendModesSeeWhatWasFiltered) {
    Group filtered = group({rect({0, 0}, {64, 64}, Color{1, 0.5f, 0.5f, 1})});
    const scene::FilterPrimitive offset{scene::OffsetFilter{}, {{}}, {0, 0}, {64, 64}, false};
    filtered.filter =
        std::make_shared<scene::Filter>(scene::Filter{scene::identity, {0, 0}, {64, 64}, {offset}});
    Group blended = group({rect({0, 0}, {64, 64}, Color{0.5f, 1, 0.5f, 1})});
    blended.blend = scene::BlendMode::Multiply;
    Group root;
    root.children = {{filtered}, {blended}};
    expectNear(pixel(picture(root), 20, 20, GetParam()), {0.5f, 0.5f, 0.25f, 1});
}

/// Engines visit all of a map.
TEST(Compile, compatMasksAreNoLargerThanNeeded) {
    const scene::Scene s = picture(group({rect({33, 34}, {35, 36}, red), rect({0, 0}, {64, 64}, blue),
                                          rect({15, 15}, {17, 17}, red), rect({70, 0}, {80, 64}, green)}));
    const asset::Asset asset = compile(s, {.mode = asset::Mode::Compat}).asset;
    asset::validate(asset);
    ASSERT_EQ(asset.maps.size(), 3u);  // nothing for what lies outside of the picture
    EXPECT_EQ(asset.maps[0].side, 16);
    EXPECT_EQ(asset.maps[0].x, 32);
    EXPECT_EQ(asset.maps[0].y, 32);
    EXPECT_EQ(asset.maps[1].side, 64);
    EXPECT_EQ(asset.maps[2].side, 64);  // it lies in four of its squares
    expectNear(pixel(s, 16, 16, asset::Mode::Compat), {1, 0, 0, 1});
    expectNear(pixel(s, 34, 34, asset::Mode::Compat), {0, 0, 1, 1});
}

scene::Material rampMaterial(float alpha, const scene::Affine& transform = scene::identity) {
    return {"ramp", "vec4 ramp(vec2 p) { return vec4(p / 64.0, 0.0, 1.0); }", {0, 0, 1, alpha}, transform};
}

TEST_P(BothModes, materialsComeThroughOnceAName) {
    auto second = rect({32, 0}, {64, 64}, rampMaterial(1, scene::translation(32, 0)));
    second.transform = scene::scaling(1, 2);
    const auto s = picture(group({rect({0, 0}, {32, 64}, rampMaterial(0.5f)), second}));
    Options options;
    options.mode = GetParam();
    const asset::Asset asset = compile(s, options).asset;
    asset::validate(asset);
    ASSERT_EQ(asset.materials.size(), 1u);
    EXPECT_EQ(asset.materials[0].name, "ramp");
    EXPECT_EQ(asset.materials[0].glsl, rampMaterial(1).glsl);
    const auto color = [](std::uint32_t, glm::vec2 p) { return glm::vec4(p.x / 64, p.y / 64, 0, 1); };
    const image::Raster drawn = asset::evaluate(asset, {64, 64}, color),
                        plain = asset::evaluate(asset, {64, 64});
    const auto at = [](const image::Raster& raster, int x, int y) {
        return std::array<float, 4>{raster.pixel(x, y)[0], raster.pixel(x, y)[1], raster.pixel(x, y)[2],
                                    raster.pixel(x, y)[3]};
    };
    expectNear(at(drawn, 10, 20), {10.5f / 64, 20.5f / 64, 0, 1});
    expectNear(at(drawn, 40, 20), {8.5f / 64, 10.25f / 64, 0, 1});
    expectNear(at(plain, 10, 20), {0, 0, 0.5f, 0.5f});
    expectNear(at(plain, 40, 20), {0, 0, 1, 1});
}

TEST(Compile, tooManyMaterialsAreALimitError) {
    Group root;
    for (std::size_t i = 0; i <= asset::maxMaterials; ++i)
        root.children.push_back({rect({0, 0}, {9, 9}, scene::Material{"m" + std::to_string(i), "", {}})});
    EXPECT_THROW(compile(picture(root)), LimitError);
}

scene::Select select(Path mask, std::vector<Item> inside, std::vector<Item> outside) {
    return {{std::make_shared<Path>(std::move(mask)), scene::identity, scene::FillRule::NonZero},
            std::make_shared<Group>(group(std::move(inside))),
            std::make_shared<Group>(group(std::move(outside)))};
}

TEST_P(BothModes, aSelectionShowsOneOfItsSidesAtEveryPoint) {
    Group root = group({rect({0, 0}, {64, 64}, green)});
    root.children.push_back(
        {select(scene::rectangle({10, 10}, {30.25, 30}), {rect({0, 0}, {64, 64}, Color{1, 0, 0, 0.5f})},
                {rect({0, 0}, {64, 64}, blue)})});
    const auto s = picture(root);
    expectNear(pixel(s, 20, 20, GetParam()), {0.5f, 0.5f, 0, 1});
    expectNear(pixel(s, 50, 50, GetParam()), {0, 0, 1, 1});
    expectNear(pixel(s, 30, 20, GetParam()), {0.125f, 0.125f, 0.75f, 1});
}

TEST_P(BothModes, theSharesOfASelectionAddUpToOne) {
    Group root;
    root.children.push_back({select(scene::rectangle({10, 10}, {30.25, 30.5}), {rect({0, 0}, {64, 64}, red)},
                                    {rect({0, 0}, {64, 64}, blue)})});
    expectNear(pixel(picture(root), 30, 20, GetParam()), {0.25f, 0, 0.75f, 1});
    expectNear(pixel(picture(root), 30, 30, GetParam()), {0.125f, 0, 0.875f, 1});
}

TEST_P(BothModes, selectionsNest) {
    const Path left = scene::rectangle({0, 0}, {32, 64}), top = scene::rectangle({0, 0}, {64, 32});
    Group inside, outside, root;
    inside.children.push_back({select(top, {rect({0, 0}, {64, 64}, red)}, {rect({0, 0}, {64, 64}, green)})});
    outside.children.push_back({select(top, {}, {rect({0, 0}, {64, 64}, blue)})});
    scene::Select both = select(left, {}, {});
    both.inside = std::make_shared<Group>(inside);
    both.outside = std::make_shared<Group>(outside);
    root.children.push_back({both});
    const auto s = picture(root);
    expectNear(pixel(s, 10, 10, GetParam()), {1, 0, 0, 1});
    expectNear(pixel(s, 10, 50, GetParam()), {0, 1, 0, 1});
    expectNear(pixel(s, 50, 10, GetParam()), {0, 0, 0, 0});
    expectNear(pixel(s, 50, 50, GetParam()), {0, 0, 1, 1});
}

TEST(Compile, anOpaqueSideHidesWhatLiesBelow) {
    Group root = group({rect({3, 5}, {40, 41}, red)});
    root.children.push_back({select(scene::rectangle({16, 16}, {48, 32}), {rect({0, 0}, {64, 64}, green)},
                                    {rect({0, 0}, {64, 64}, blue)})});
    EXPECT_EQ(asset::summarize(compile(picture(root)).asset).pieces, 0u);
}

TEST_P(BothModes, gradientsAreEvaluatedWherePixelsAre) {
    scene::LinearGradient g{{0, 0}, {64, 0}, {{0, black}, {1, white}}};
    const auto s = picture(group({rect({0, 0}, {64, 64}, g)}));
    expectNear(pixel(s, 31, 20, GetParam()), {31.5f / 64, 31.5f / 64, 31.5f / 64, 1}, 2e-3f);
}

TEST_P(BothModes, patternsRepeat) {
    scene::Pattern pattern{{0, 0}, {16, 16}, std::make_shared<Group>(group({rect({0, 0}, {8, 30}, red)}))};
    const auto s = picture(group({rect({4, 4}, {60, 60}, pattern)}));
    expectNear(pixel(s, 20, 40, GetParam()), {1, 0, 0, 1});
    expectNear(pixel(s, 28, 40, GetParam()), {0, 0, 0, 0});
    expectNear(pixel(s, 2, 2, GetParam()), {0, 0, 0, 0});
}

TEST_P(BothModes, picturesThatAreNotSquareAreCutAtTheirBorder) {
    const auto s = picture(group({rect({-100, -100}, {200, 200}, red)}), 64, 20);
    Options options;
    options.mode = GetParam();
    const asset::Asset asset = compile(s, options).asset;
    const image::Raster raster = asset::evaluate(asset, {64, 64});
    EXPECT_NEAR(raster.pixel(30, 10)[3], 1, 1e-4);
    EXPECT_NEAR(raster.pixel(30, 30)[3], 0, 1e-4);
}

TEST(Compile, aPlainGroundIsOneSolid) {
    const auto result = compile(picture(group({rect({0, 0}, {64, 64}, red)})));
    const asset::Summary summary = asset::summarize(result.asset);
    EXPECT_EQ(summary.leaves, 0u);
    EXPECT_EQ(summary.maxDepth, 0u);
}

TEST(Compile, noLeafIsDeeperThanAsked) {
    Group many;
    for (int i = 0; i < 400; ++i) {
        const Point at{3.1 * (i % 20) + 0.7, 3.1 * (i / 20) + 0.9};
        many.children.push_back({rect(at, at + 1.3, i % 2 ? red : blue)});
    }
    for (const unsigned depth : {0u, 1u, 2u, 3u}) {
        const Options options{.maxDepth = depth};
        EXPECT_LE(asset::summarize(compile(picture(many), options).asset).maxDepth, depth);
        EXPECT_LE(asset::summarize(Session(picture(many), options).result().asset).maxDepth, depth);
    }
}

TEST(Compile, aRectangleOnCellBordersLeavesNoPieces) {
    const auto result =
        compile(picture(group({rect({0, 0}, {64, 64}, red), rect({16, 16}, {48, 32}, blue)})));
    EXPECT_EQ(asset::summarize(result.asset).pieces, 0u);
    EXPECT_EQ(asset::summarize(result.asset).solids, 16u);
}

TEST(Compile, whatLiesUnderAnOpaqueCoverCostsNothing) {
    Group hidden =
        group({rect({3, 5}, {40, 41}, red), rect({7, 9}, {60, 33}, blue), rect({0, 0}, {64, 64}, green)});
    EXPECT_EQ(asset::summarize(compile(picture(hidden)).asset).leaves, 0u);
}

TEST(Compile, abuttingShapesOfOneColourLeaveNoBoundary) {
    const auto triangle = [](Point a, Point b, Point c) {
        Item item;
        item.path = std::make_shared<Path>(
            Path{scene::MoveTo{a}, scene::LineTo{b}, scene::LineTo{c}, scene::Close{}});
        item.geometry = scene::FillRule::NonZero;
        item.paint = red;
        return item;
    };
    const auto s =
        picture(group({triangle({-5, -5}, {70, -5}, {70, 70}), triangle({-5, -5}, {70, 70}, {-5, 70})}));
    EXPECT_EQ(asset::summarize(compile(s).asset).pieces, 0u);
}

TEST(Compile, noLeafNeedsItsFallbackInATangle) {
    Group root;
    unsigned state = 1;
    const auto random = [&] {
        return static_cast<double>((state = state * 1664525u + 1013904223u) >> 8) / (1 << 24) * 80 - 8;
    };
    for (int i = 0; i < 30; ++i) {
        Item item;
        Path path{scene::MoveTo{{random(), random()}}};
        for (int k = 0; k < 4; ++k)
            path.push_back(scene::CubicTo{{random(), random()}, {random(), random()}, {random(), random()}});
        item.path = std::make_shared<Path>(path);
        item.geometry = i % 2 ? scene::FillRule::EvenOdd : scene::FillRule::NonZero;
        item.paint = Color{0.1f * static_cast<float>(i % 7), 0.5f, 0.2f, 1};
        root.children.push_back({item});
    }
    const asset::Asset asset = compile(picture(root)).asset;
    EXPECT_EQ(asset.fallbackLeaves, 0u);
    EXPECT_NO_THROW(asset::validate(asset));
}

TEST(Compile, optionsOutOfRangeAreRefused) {
    const auto s = picture(group({}));
    EXPECT_THROW(compile(s, {.tolerance = 0}), std::invalid_argument);
    EXPECT_THROW(compile(s, {.piecesPerLeaf = 0}), std::invalid_argument);
    EXPECT_THROW(compile(s, {.maxDepth = 13}), std::invalid_argument);
}

TEST(Compile, compatModeNestsAsDeepAsTheFormat) {
    const auto nested = [](unsigned groups) {
        Group inner = group({rect({0, 0}, {8, 8}, red)});
        for (unsigned i = 0; i < groups; ++i) {
            Group outer;
            outer.opacity = 0.999f;
            outer.children = {{rect({8, 8}, {16, 16}, red)}, {inner}};
            inner = outer;
        }
        return picture(inner);
    };
    const Options compat{.mode = asset::Mode::Compat};
    // The picture itself and its root take two of the stack's places.
    EXPECT_NO_THROW(asset::validate(compile(nested(asset::maxPictures - 3), compat).asset));
    EXPECT_THROW(compile(nested(asset::maxPictures), compat), LimitError);
}

/// Beyond a limit of one item, only that item is left out.
TEST(Compile, tooManyDashesAreLeftOut) {
    scene::StrokeStyle stroke;
    stroke.dashes = {1e-9, 1e-9};
    Item line = rect({1, 1}, {60, 60}, red);
    line.geometry = stroke;
    const Result result = compile(picture(group({line, rect({8, 8}, {16, 16}, red)})));
    ASSERT_EQ(result.warnings.size(), 1u);
    EXPECT_NE(result.warnings[0].find("dashes"), std::string::npos);
    EXPECT_EQ(result.asset.paints.size(), 2u);
}

TEST(Compile, namesItsStages) {
    std::vector<std::string> names;
    for (const StageTime& s : compile(picture(group({}))).stages)
        names.push_back(s.stage);
    EXPECT_EQ(names, (std::vector<std::string>{"lower", "divide", "planarise", "fit", "encode"}));
}

}  // namespace
}  // namespace vtm::compiler
