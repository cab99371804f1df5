#include <vtm/authoring.hpp>

#include <gtest/gtest.h>

#include <vtm/asset/container.hpp>
#include <vtm/raster/evaluate.hpp>

namespace vtm {
namespace {

using scene::Color;
using scene::Point;

constexpr Color red{1, 0, 0, 1}, green{0, 1, 0, 1}, blue{0, 0, 1, 1};
constexpr double side = 64;

Mask box(Point min, Point max) { return filled(scene::rectangle(min, max)); }

void expectPixel(const Vtm& vtm, int x, int y, std::array<float, 4> expected) {
    const asset::Asset asset = compile(vtm, side, side).asset;
    asset::validate(asset);
    const image::Raster raster = asset::evaluate(asset, {int(side), int(side)});
    for (int c = 0; c < 4; ++c)
        EXPECT_NEAR(raster.pixel(x, y)[c], expected[std::size_t(c)], 1e-3f)
            << "pixel " << x << ", " << y << " channel " << c;
}

TEST(Vtm, NothingIsTransparent) { expectPixel({}, 9, 9, {0, 0, 0, 0}); }

TEST(Vtm, APaintCoversThePlane) {
    expectPixel(Vtm::paint(red), 0, 0, {1, 0, 0, 1});
    expectPixel(Vtm::paint(red, 0.5f), 63, 63, {0.5f, 0, 0, 0.5f});
}

TEST(Vtm, SelectionIsAChoiceAndNotALayer) {
    const Vtm chosen = Vtm::select(box({8, 8}, {32, 32}), Vtm::paint(red, 0.5f), Vtm::paint(blue));
    expectPixel(chosen, 16, 16, {0.5f, 0, 0, 0.5f});
    expectPixel(chosen, 40, 16, {0, 0, 1, 1});
    expectPixel(Vtm::over(chosen, Vtm::paint(green)), 16, 16, {0.5f, 0.5f, 0, 1});
}

TEST(Vtm, WithoutAnOutsideItIsAPrimitive) {
    scene::StrokeStyle pen;
    pen.width = 8;
    const Vtm line =
        Vtm::select(stroked({scene::MoveTo{{0, 20}}, scene::LineTo{{64, 20}}}, pen), Vtm::paint(red));
    expectPixel(line, 30, 18, {1, 0, 0, 1});
    expectPixel(line, 30, 30, {0, 0, 0, 0});
}

TEST(Vtm, SidesAreVtmsAgain) {
    const Vtm columns = Vtm::select(box({0, 0}, {32, 64}), Vtm::paint(red), Vtm::paint(green));
    const Vtm nested =
        Vtm::select(box({0, 0}, {64, 32}), columns, Vtm::select(box({0, 0}, {48, 64}), {}, columns));
    expectPixel(nested, 10, 10, {1, 0, 0, 1});
    expectPixel(nested, 40, 10, {0, 1, 0, 1});
    expectPixel(nested, 10, 50, {0, 0, 0, 0});
    expectPixel(nested, 60, 50, {0, 1, 0, 1});
}

TEST(Vtm, PlacingMovesMasksAndPaintsTogether) {
    const scene::LinearGradient ramp{{0, 0}, {8, 0}, {{0, Color{0, 0, 0, 1}}, {1, Color{1, 1, 1, 1}}}};
    const Vtm tile = Vtm::select(box({0, 0}, {8, 8}), Vtm::paint(ramp), Vtm::paint(blue));
    const Vtm large = tile.placed(scene::scaling(4, 4)).placed(scene::translation(16, 16));
    expectPixel(large, 15, 20, {0, 0, 1, 1});
    expectPixel(large, 16, 20, {0.5f / 32, 0.5f / 32, 0.5f / 32, 1});
    expectPixel(large, 31, 20, {15.5f / 32, 15.5f / 32, 15.5f / 32, 1});
    EXPECT_EQ(tile.placed(scene::identity), tile);
}

TEST(Vtm, PlacingMovesClipsAndMasksOfLayersToo) {
    Compositing how;
    auto clip = std::make_shared<scene::Clip>();
    clip->shapes.push_back({filled(scene::rectangle({0, 0}, {10, 10})).path, scene::identity,
                            scene::FillRule::NonZero, nullptr});
    how.clip = clip;
    const Vtm half = Vtm::select(box({0, 0}, {5, 64}), Vtm::paint(Color{1, 1, 1, 1}));
    how.mask = std::make_shared<scene::Mask>(scene::Mask{
        std::make_shared<scene::Group>(half.toScene(64, 64).root), scene::MaskKind::Alpha, false});
    const Vtm layer = Vtm::layer(Vtm::paint(red), Vtm::paint(blue), how).placed(scene::translation(20, 20));
    expectPixel(layer, 22, 25, {1, 0, 0, 1});
    expectPixel(layer, 27, 25, {0, 0, 1, 1});
    expectPixel(layer, 22, 31, {0, 0, 1, 1});
    expectPixel(layer, 10, 10, {0, 0, 1, 1});
}

TEST(Vtm, LayersBlendWithWhatIsBelow) {
    Compositing multiply;
    multiply.blend = scene::BlendMode::Multiply;
    multiply.opacity = 0.5f;
    const Vtm below = Vtm::paint(Color{1, 0.5f, 0, 1});
    expectPixel(Vtm::layer(Vtm::paint(green), below, multiply), 9, 9, {0.5f, 0.5f, 0, 1});
    // Isolated: what lies further down is not seen.
    const Vtm alone = Vtm::over(Vtm::layer(Vtm::paint(green), {}, multiply), below);
    expectPixel(alone, 9, 9, {0.5f, 0.75f, 0, 1});
}

TEST(Vtm, PaintsInAMaskAreItems) {
    const scene::Affine turn{0, 1, -1, 0, 0, 0};
    Mask mask = box({0, 0}, {8, 8});
    mask.transform = scene::scaling(2, 4);
    const scene::ImagePaint picture{std::make_shared<image::Bitmap>(image::Bitmap{1, 1, {1, 2, 3, 4}})};
    const scene::Scene scene = Vtm::select(mask, Vtm::paint(picture).placed(turn)).toScene(side, side);
    const auto& item = std::get<scene::Item>(scene.root.children.at(0).value);
    EXPECT_EQ(item.path, mask.path);
    EXPECT_EQ(item.transform, mask.transform);
    const auto& paint = std::get<scene::ImagePaint>(item.paint);
    EXPECT_EQ(scene::compose(item.transform, paint.transform), turn);
    mask.transform = scene::scaling(2, 0);
    EXPECT_TRUE(Vtm::select(mask, Vtm::paint(picture)).toScene(side, side).root.children.empty());
}

TEST(Vtm, SharedPartsStayShared) {
    Vtm part = Vtm::paint(red);
    for (int i = 0; i < 60; ++i)  // as a tree: 2^60 paints
        part = Vtm::select(box({0, 0}, {double(i), 9}), Vtm::layer(part, {}, {0.5f}), part);
    const scene::Scene scene = part.toScene(side, side);
    scene::validate(scene);
    EXPECT_LT(scene::dump(scene).size(), 100'000u);
}

TEST(Vtm, NestingBeyondTheScenesLimitIsAnError) {
    Vtm part = Vtm::paint(red);
    for (int i = 0; i < 5000; ++i)
        part = Vtm::select(box({0, 0}, {1, 1}), Vtm::paint(blue), part);
    EXPECT_THROW(part.toScene(side, side), scene::InvalidScene);
}

constexpr int million = 1'000'000;

TEST(Vtm, AMillionSelectionsInEachOther) {
    const Mask mask = box({0, 0}, {1, 1});
    const Vtm paint = Vtm::paint(blue);
    Vtm inside = Vtm::paint(red), outside = inside, placed = inside, layers = inside;
    for (int i = 0; i < million; ++i) {
        inside = Vtm::select(mask, inside, paint);
        outside = Vtm::select(mask, paint, outside);
        placed = placed.placed(scene::translation(1, 0));
        layers = Vtm::layer(layers, paint, {0.5f});
    }
    EXPECT_THROW(inside.toScene(side, side), scene::InvalidScene);
    EXPECT_THROW(outside.toScene(side, side), scene::InvalidScene);
    EXPECT_THROW(layers.toScene(side, side), scene::InvalidScene);
    EXPECT_EQ(placed.toScene(side, side).root.children.size(), 1u);
}

TEST(Vtm, AMillionLayersOverEachOther) {
    const Mask mask = box({0, 0}, {1, 1});
    Vtm chain = Vtm::paint(red);
    for (int i = 0; i < million; ++i)
        chain = Vtm::select(mask, Vtm::over(Vtm::paint(blue), chain), chain);
    EXPECT_EQ(chain.toScene(side, side).root.children.size(), std::size_t{million} + 1);
}

TEST(Vtm, AMillionGroupsClipsOrMasksInEachOther) {
    scene::Scene deep{1, 1, {}};
    Compositing clipped, masked;
    for (int i = 0; i < million; ++i) {
        scene::Group outer, hidden;
        outer.children.push_back({std::move(deep.root)});
        deep.root = std::move(outer);
        clipped.clip = std::make_shared<const scene::Clip>(scene::Clip{{}, clipped.clip});
        hidden.mask = masked.mask;
        masked.mask = std::make_shared<const scene::Mask>(
            scene::Mask{std::make_shared<const scene::Group>(std::move(hidden))});
    }
    EXPECT_THROW(Vtm::fromScene(deep), scene::InvalidScene);
    const auto at = scene::translation(1, 0);
    for (const Compositing& how : {clipped, masked})
        EXPECT_THROW(Vtm::layer(Vtm::paint(red), {}, how).placed(at).toScene(side, side),
                     scene::InvalidScene);
}

TEST(Vtm, MaterialsAndImagesReachTheAsset) {
    const Vtm vtm = Vtm::select(box({0, 0}, {32, 64}),
                                Vtm::material("plain", "vec4 plain(vec2 p) { return vec4(1.0); }", green),
                                Vtm::image({1, 1, {255, 0, 0, 255}}).placed(scene::scaling(64, 64)));
    const asset::Asset asset = compile(vtm, side, side).asset;
    ASSERT_EQ(asset.materials.size(), 1u);
    EXPECT_EQ(asset.materials[0].name, "plain");
    EXPECT_EQ(asset.images.size(), 1u);
    expectPixel(vtm, 9, 9, {0, 1, 0, 1});
    expectPixel(vtm, 50, 9, {1, 0, 0, 1});
}

}  // namespace
}  // namespace vtm
