// What compile() makes can be written and read; what the format cannot hold is a LimitError that says so.

#include <gtest/gtest.h>

#include <vtm/asset/container.hpp>
#include <vtm/compiler/compile.hpp>
#include <vtm/compiler/session.hpp>
#include <vtm/raster/evaluate.hpp>
#include <vtm/raster/scan.hpp>
#include "compiler/tree/encode.hpp"

namespace vtm::compiler {
namespace {

using namespace scene;

/// A rectangle over the whole picture.
Node filled(const Scene& picture, Paint paint) {
    Item item;
    item.path = std::make_shared<Path>(rectangle({0, 0}, {picture.width, picture.height}));
    item.geometry = FillRule::NonZero;
    item.paint = std::move(paint);
    return {item};
}

Scene pictureOf(const std::vector<Paint>& paints, double side = 64) {
    Scene scene{side, side, {}};
    for (const Paint& paint : paints)
        scene.root.children.push_back(filled(scene, paint));
    return scene;
}

/// What is read draws what was compiled: colours, no NaN.
void expectStored(const Scene& scene) {
    const asset::Asset made = compile(scene).asset;
    const std::vector<std::uint8_t> file = asset::write(made);
    const asset::Asset back = asset::read(file);
    EXPECT_EQ(asset::write(back), file);
    const asset::View view{4, 4, {4 / scene.width, 0, 0, 4 / scene.height, 0, 0}};
    for (const image::Raster& raster : {asset::evaluate(back, view), asset::Scanner(back).draw(view)})
        for (const float value : raster.rgba)
            EXPECT_TRUE(value >= 0 && value <= 1) << value;
}

std::string refusalOf(const Scene& scene) {
    std::string compiled, edited;
    try {
        compile(scene);
    } catch (const LimitError& error) {
        compiled = error.what();
    }
    try {
        const Session session(scene);
    } catch (const LimitError& error) {
        edited = error.what();
    }
    EXPECT_EQ(compiled, edited);
    return compiled;
}

std::vector<GradientStop> redToBlue() { return {{0, {1, 0, 0, 1}}, {1, {0, 0, 1, 1}}}; }

TEST(Format, SidesOfPictures) {
    for (const double side : {minSide, 1.0, maxSide})
        expectStored(pictureOf({Paint(scene::Color{1, 0, 0, 1})}, side));
    for (const double side : {0.9 * minSide, 1e-38, 1.1 * maxSide, 1e38})
        EXPECT_THROW(compile(pictureOf({Paint(scene::Color{})}, side)), InvalidScene) << side;
}

/// Their matrices are beyond single precision.
TEST(Format, TinyGradients) {
    for (const double length : {1e-12, 1e-25, 1e-36, 1e-45, 1e-150})
        for (const double side : {minSide, 64.0, maxSide})
            for (const Spread spread : {Spread::Pad, Spread::Reflect, Spread::Repeat}) {
                SCOPED_TRACE(length);
                const Point middle(side / 2), end = Point(length, 0) * side;
                const Affine moved = translation(middle.x, middle.y);
                expectStored(pictureOf({LinearGradient{{0, 0}, end, redToBlue(), spread, moved}}, side));
                expectStored(
                    pictureOf({RadialGradient{{0, 0}, end.x, {0, 0}, 0, redToBlue(), spread, moved}}, side));
            }
}

TEST(Format, TinyGradientsShowTheirEnds) {
    const Scene scene =
        pictureOf({LinearGradient{{32, 0}, {32 + 1e-13, 0}, redToBlue()},
                   LinearGradient{{0, 0}, {1e-60, 0}, redToBlue(), Spread::Pad, translation(32, 0)}});
    for (const Node& node : scene.root.children) {
        Scene one{64, 64, {}};
        one.root.children = {node};
        const image::Raster drawn =
            asset::evaluate(compile(one).asset, {2, 1, {2.0 / 64, 0, 0, 1.0 / 64, 0, 0}});
        EXPECT_NEAR(drawn.pixel(0, 0)[0], 1, 1e-3);
        EXPECT_NEAR(drawn.pixel(1, 0)[2], 1, 1e-3);
    }
}

TEST(Format, TinyImagesAndMaterials) {
    const auto bitmap = std::make_shared<image::Bitmap>(image::Bitmap{1, 1, {255, 0, 0, 255}});
    for (const double scale : {1e-25, 1e-45, 1e-150}) {
        const Affine tiny{scale, 0, 0, scale, 32, 32};
        for (const ImageFilter filter :
             {ImageFilter::Nearest, ImageFilter::Bilinear, ImageFilter::Trilinear, ImageFilter::Bicubic})
            expectStored(pictureOf({ImagePaint{bitmap, filter, tiny}}));
        expectStored(
            pictureOf({Material{"m", "vec4 m(vec2 p) { return vec4(p, 0, 1); }", {1, 0, 0, 1}, tiny}}));
    }
}

TEST(Format, FocalCirclesNextToTheEndCircle) {
    for (const double below : {1e-7, 1e-9, 1e-14}) {
        RadialGradient g{{32, 32}, 30, {32, 32}, 30 * (1 - below), redToBlue()};
        expectStored(pictureOf({g}));
        g.focalRadius = 0;
        g.focus.x += 30 * (1 - below);
        expectStored(pictureOf({g}));
    }
}

TEST(Format, TooManyLayersOverAPoint) {
    LinearGradient veil{{0, 0}, {64, 0}, redToBlue()};
    veil.stops[0].color.a = veil.stops[1].color.a = 0.5f;
    expectStored(pictureOf(std::vector<Paint>(asset::maxInstructions, veil)));
    EXPECT_EQ(refusalOf(pictureOf(std::vector<Paint>(asset::maxInstructions + 1, veil))),
              "more than 4096 layers and groups that cannot be folded overlap at one point");
}

TEST(Format, TooManyPixelsOfImages) {
    const auto image = [](int side) {
        const auto pixels = std::size_t(side) * std::size_t(side);
        return ImagePaint{std::make_shared<image::Bitmap>(
            image::Bitmap{side, side, std::vector<std::uint8_t>(4 * pixels)})};
    };
    const ImagePaint large = image(8192), more = image(1);
    EXPECT_EQ(refusalOf(pictureOf({large, large})), "") << "the same twice is stored once";
    EXPECT_EQ(refusalOf(pictureOf({large, more})),
              "the picture's images have more than 67108864 pixels together");
}

TEST(Format, TooManySquaresAndPieces) {
    EXPECT_NO_THROW(checkDrawn(1, 100, asset::maxDrawn - 1601));
    EXPECT_THROW(checkDrawn(1, 100, asset::maxDrawn - 1600), LimitError);
    EXPECT_THROW(checkDrawn(1, asset::maxDrawn / 16, 0), LimitError);
}

}  // namespace
}  // namespace vtm::compiler
