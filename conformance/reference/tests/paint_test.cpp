/// Gradients, patterns and images.
#include <cmath>

#include "conformance/reference/tests/scenes.hpp"

namespace vtm::reference {
namespace {

class Paints : public BothModes {};
INSTANTIATE_TEST_SUITE_P(Render, Paints, testing::Values(Mode::Exact, Mode::Compat),
                         [](const auto& mode) { return mode.param == Mode::Exact ? "Exact" : "Compat"; });

const std::vector<GradientStop> blackToRed{{0, black}, {1, red}};

LinearGradient linear(Point start, Point end, Spread spread = Spread::Pad) {
    return {start, end, blackToRed, spread, identity};
}

TEST_P(Paints, LinearGradientAtPixelCentres) {
    const auto raster = draw(sceneOf({{fillAll(linear({2, 0}, {6, 0}))}}));
    expectPixel(raster, 0, 3, {0, 0, 0, 1});
    expectPixel(raster, 2, 3, {0.125, 0, 0, 1});
    expectPixel(raster, 5, 3, {0.875, 0, 0, 1});
    expectPixel(raster, 7, 3, {1, 0, 0, 1});
}

TEST_P(Paints, GradientLinesSlant) {
    // Offset (x + y) / 8 along the diagonal.
    const auto raster = draw(sceneOf({{fillAll(linear({0, 0}, {4, 4}))}}));
    expectPixel(raster, 1, 2, {0.5, 0, 0, 1});
    expectPixel(raster, 3, 1, {0.625, 0, 0, 1});
}

TEST_P(Paints, SpreadsRepeatAndReflect) {
    const auto repeated = draw(sceneOf({{fillAll(linear({2, 0}, {4, 0}, Spread::Repeat))}}));
    expectPixel(repeated, 0, 3, {0.25, 0, 0, 1});
    expectPixel(repeated, 5, 3, {0.75, 0, 0, 1});
    const auto reflected = draw(sceneOf({{fillAll(linear({2, 0}, {4, 0}, Spread::Reflect))}}));
    expectPixel(reflected, 1, 3, {0.25, 0, 0, 1});
    expectPixel(reflected, 0, 3, {0.75, 0, 0, 1});
    expectPixel(reflected, 4, 3, {0.75, 0, 0, 1});
    expectPixel(reflected, 5, 3, {0.25, 0, 0, 1});
    expectPixel(reflected, 6, 3, {0.25, 0, 0, 1});
}

TEST_P(Paints, StopsInterpolateStraightColours) {
    LinearGradient g = linear({0, 0}, {8, 0});
    g.stops = {{0, red}, {1, Color{0, 1, 0, 0}}};
    const auto raster = draw(sceneOf({{fillAll(g)}}), 16);  // two pixels a unit
    const double t = 8.5 / 16;
    expectPixel(raster, 8, 3, {(1 - t) * (1 - t), t * (1 - t), 0, 1 - t}, 2e-3);
}

TEST(Paints, HardStopsInsideAPixel) {
    LinearGradient g = linear({0, 0}, {8, 0});
    g.stops = {{0, red}, {0.40625f, red}, {0.40625f, blue}, {1, blue}};  // at x = 3.25
    const Scene scene = sceneOf({{fillAll(g)}});
    expectPixel(renderAt(scene, Mode::Exact), 3, 3, {0.25, 0, 0.75, 1});
    expectPixel(renderAt(scene, Mode::Compat), 3, 3, {0.25, 0, 0.75, 1});
}

LinearGradient redThenBlue(Point start, Point end) {
    LinearGradient g = linear(start, end);
    g.stops = {{0, red}, {0.5f, red}, {0.5f, blue}, {1, blue}};
    return g;
}

TEST_P(Paints, HardStopsCutATriangleOffAPixel) {
    // From (3, 4) to (4, 4 - 1/16): a triangle of 1/32, between the points of a grid of 8 × 8.
    const Point middle(3, 4), across = 4.0 * Point(1.0 / 16, 1);
    const auto raster = draw(sceneOf({{fillAll(redThenBlue(middle - across, middle + across))}}));
    expectPixel(raster, 3, 3, {31.0 / 32, 0, 1.0 / 32, 1}, 1e-4);
}

TEST_P(Paints, HardStopsAlongARowLieBetweenPoints) {
    const double beside = 3 + 1.0 / 64;
    const auto across = draw(sceneOf({{fillAll(redThenBlue({beside - 4, 0}, {beside + 4, 0}))}}));
    expectPixel(across, 3, 3, {1.0 / 64, 0, 63.0 / 64, 1});
    const auto down = draw(sceneOf({{fillAll(redThenBlue({0, beside - 4}, {0, beside + 4}))}}));
    expectPixel(down, 3, 3, {1.0 / 64, 0, 63.0 / 64, 1});
}

TEST(Paints, ThousandsOfStopsUnderAnEdgeAreTheirMean) {
    // 32 red and 32 blue bands a pixel, as many as points, up to the middle of pixel 3.
    LinearGradient g = linear({0, 0}, {8, 0});
    g.stops.clear();
    constexpr int bands = 8 * 64;
    for (int i = 0; i < bands; ++i)
        for (const int end : {i, i + 1})
            g.stops.push_back({float(end) / bands, i % 2 == 0 ? red : blue});
    const auto raster = renderAt(sceneOf({{fill(rectangle({0, 0}, {3.5, 8}), g)}}), Mode::Exact);
    expectPixel(raster, 2, 3, {0.5, 0, 0.5, 1});
    expectPixel(raster, 3, 3, {0.25, 0, 0.25, 0.5});
}

TEST(Paints, PeriodsSmallerThanASampleAreTheirMean) {
    for (const Spread spread : {Spread::Repeat, Spread::Reflect}) {
        const Scene scene = sceneOf({{fillAll(linear({0, 0}, {0.001, 0.002}, spread))}});
        expectPixel(renderAt(scene, Mode::Exact), 3, 3, {0.5, 0, 0, 1}, 1e-3);
    }
}

TEST_P(Paints, RadialGradientIsTheDistance) {
    const RadialGradient g{{4, 4}, 4, {4, 4}, 0, blackToRed, Spread::Pad, identity};
    const auto raster = draw(sceneOf({{fillAll(g)}}), 64);  // eight pixels a unit
    for (const auto& [x, y] : {std::pair{32, 10}, {50, 40}, {12, 12}}) {
        const double distance = std::hypot((x + 0.5) / 8 - 4, (y + 0.5) / 8 - 4) / 4;
        expectPixel(raster, x, y, {std::min(1.0, distance), 0, 0, 1}, 1e-3);
    }
}

TEST_P(Paints, FocalCircle) {
    // Focus (2, 4) of radius 1, end circle about (4, 4) of radius 4: on the axis to the right the
    // circle of offset t passes through 2 + 2t + 1 + 3t, to the left through 2 + 2t - 1 - 3t.
    const RadialGradient g{{4, 4}, 4, {2, 4}, 1, blackToRed, Spread::Pad, identity};
    const auto raster = draw(sceneOf({{fillAll(g)}}), 160);
    const auto offset = [](double x) { return x > 2 ? (x - 3) / 5 : 1 - x; };
    expectPixel(raster, 120, 80, {offset(120.5 / 20), 0, 0, 1}, 1e-3);
    expectPixel(raster, 10, 80, {offset(10.5 / 20), 0, 0, 1}, 1e-3);
    expectPixel(raster, 45, 80, {0, 0, 0, 1}, 1e-3);  // inside the focal circle
}

TEST_P(Paints, GradientTransformAndItemTransformCompose) {
    LinearGradient g = linear({0, 0}, {1, 0});
    g.transform = scaling(4, 4);
    Item item = fillAll(g);
    item.transform = translation(2, 0);
    const auto raster = draw(sceneOf({{item}}));
    expectPixel(raster, 3, 3, {0.375, 0, 0, 1});
}

TEST_P(Paints, PaintWithoutInverseShowsNothing) {
    LinearGradient g = linear({0, 0}, {1, 0});
    g.transform = scaling(1, 0);
    expectPixel(draw(sceneOf({{fillAll(blue)}, {fillAll(g)}})), 3, 3, {0, 0, 1, 1});
}

/// A tile of 4 × 2 from (1, 0): red on its left half, and a blue square that reaches out of the tile.
Pattern stripes() {
    auto content = std::make_shared<const Group>(
        group({{fill(rectangle({1, 0}, {3, 2}), red)}, {fill(rectangle({4, 0}, {6, 1}), blue)}}));
    return {{1, 0}, {5, 2}, content, identity};
}

TEST_P(Paints, PatternRepeatsClippedToItsTile) {
    const auto raster = draw(sceneOf({{fillAll(stripes())}}));
    for (const int y : {0, 2, 6}) {
        expectPixel(raster, 1, y, {1, 0, 0, 1});
        expectPixel(raster, 3, y, {0, 0, 0, 0});
        expectPixel(raster, 4, y, {0, 0, 1, 1});
        expectPixel(raster, 5, y, {1, 0, 0, 1});  // blue is cut at x = 5
        expectPixel(raster, 0, y, {0, 0, 1, 1});
        expectPixel(raster, 4, y + 1, {0, 0, 0, 0});
    }
}

TEST_P(Paints, PatternSmallerThanAPixel) {
    Pattern pattern = stripes();
    pattern.transform = scaling(0.125, 0.125);
    // Half the tile is red, an eighth blue. Compat mode samples it.
    expectPixel(draw(sceneOf({{fillAll(pattern)}})), 3, 3, {0.5, 0, 0.125, 0.625},
                GetParam() == Mode::Exact ? 1e-6 : 0.02);
}

TEST_P(Paints, PatternOfTooManyTilesIsSampled) {
    Pattern pattern = stripes();
    pattern.transform = scaling(0.007, 0.011);
    expectPixel(draw(sceneOf({{fillAll(pattern)}})), 3, 3, {0.5, 0, 0.125, 0.625}, 0.1);
}

TEST_P(Paints, PatternOnAStrokeWithOpacity) {
    Item item = fill({MoveTo{{0, 4}}, LineTo{{8, 4}}}, stripes(), 0.5f);
    item.geometry = StrokeStyle{3, Cap::Butt, Join::Miter, 4, {}, 0};
    const auto raster = draw(sceneOf({{item}}));
    expectPixel(raster, 1, 4, {0.5, 0, 0, 0.5});
    expectPixel(raster, 1, 5, {0.25, 0, 0, 0.25});
    expectPixel(raster, 4, 4, {0, 0, 0.5, 0.5});
    expectPixel(raster, 1, 1, {0, 0, 0, 0});
}

TEST_P(Paints, PatternTurns) {
    Pattern pattern = stripes();
    pattern.transform = {0, 1, -1, 0, 8, 0};  // (x, y) to (8 - y, x)
    const auto raster = draw(sceneOf({{fillAll(pattern, 0.5f)}}));
    expectPixel(raster, 7, 1, {0.5, 0, 0, 0.5});
    expectPixel(raster, 7, 4, {0, 0, 0.5, 0.5});
    expectPixel(raster, 6, 4, {0, 0, 0, 0});
}

TEST_P(Paints, PatternsHoldPatternsAndMasks) {
    auto inner = std::make_shared<const Group>(group({{fill(rectangle({0, 0}, {1, 2}), green)}}));
    Group content = group({{fill(rectangle({0, 0}, {4, 4}), Pattern{{0, 0}, {2, 2}, inner, identity})}});
    content.mask = std::make_shared<const Mask>(
        Mask{std::make_shared<const Group>(group({{fill(rectangle({0, 0}, {4, 2}), white)}})),
             MaskKind::Alpha, false});
    const auto raster =
        draw(sceneOf({{fillAll(Pattern{{0, 0}, {4, 4}, std::make_shared<const Group>(content), identity})}}));
    expectPixel(raster, 6, 5, {0, 1, 0, 1});
    expectPixel(raster, 7, 5, {0, 0, 0, 0});
    expectPixel(raster, 6, 7, {0, 0, 0, 0});
}

ImagePaint picture(ImageFilter filter) {
    auto bitmap = std::make_shared<image::Bitmap>();
    bitmap->width = bitmap->height = 2;
    bitmap->rgba = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 0};
    return {bitmap, filter, scaling(2, 2)};
}

TEST_P(Paints, NearestImage) {
    const auto raster = draw(sceneOf({{fillAll(picture(ImageFilter::Nearest))}}));
    expectPixel(raster, 1, 1, {1, 0, 0, 1});
    expectPixel(raster, 2, 1, {0, 1, 0, 1});
    expectPixel(raster, 1, 2, {0, 0, 1, 1});
    expectPixel(raster, 2, 2, {0, 0, 0, 0});
    expectPixel(raster, 7, 0, {0, 1, 0, 1});  // the border goes on
    expectPixel(raster, 7, 7, {0, 0, 0, 0});
}

TEST_P(Paints, BilinearImageIsPremultiplied) {
    const auto raster = draw(sceneOf({{fillAll(picture(ImageFilter::Bilinear))}}));
    // (1.5, 1.5) lies a quarter of the way from the first texel's centre, both ways.
    expectPixel(raster, 1, 1, {0.5625, 0.1875, 0.1875, 0.9375}, 1e-6);
    expectPixel(raster, 0, 0, {1, 0, 0, 1}, 1e-6);
    expectPixel(raster, 2, 2, {0.0625, 0.1875, 0.1875, 0.4375}, 1e-6);
}

/// 16 x 16 pixels, opaque, the green of (x, y) given by a function.
template <class Function>
ImagePaint greens(ImageFilter filter, double pixelSize, Function&& function) {
    auto bitmap = std::make_shared<image::Bitmap>();
    bitmap->width = bitmap->height = 16;
    for (int i = 0; i < 256; ++i)
        bitmap->rgba.insert(bitmap->rgba.end(), {0, std::uint8_t(function(i % 16, i / 16)), 0, 255});
    return {bitmap, filter, scaling(pixelSize, pixelSize)};
}

TEST_P(Paints, TrilinearImagesAreMeansWhereMinified) {
    const auto blocks = [](int x, int y) { return x / 2 * 20 + y / 2 * 10 + (x + y) % 2 * 40; };
    // 8 pixels show 16: level 1, whose texels are these pixels; the checks are gone.
    const auto half = draw(sceneOf({{fillAll(greens(ImageFilter::Trilinear, 0.5, blocks))}}));
    expectPixel(half, 2, 5, {0, (2 * 20 + 5 * 10 + 20) / 255.0, 0, 1}, 1e-6);
    // A third of the size: means of three pixels.
    const auto ramp = [](int x, int) { return x * 16; };
    const auto third = draw(sceneOf({{fillAll(greens(ImageFilter::Trilinear, 1.0 / 3, ramp))}}));
    expectPixel(third, 2, 1, {0, 7 * 16 / 255.0, 0, 1}, 1e-6);
    // 4 / 15 of it: pixel 2 is [7.5, 11.25], half of it read there, half on level 1.
    const auto between = draw(sceneOf({{fillAll(greens(ImageFilter::Trilinear, 4.0 / 15, ramp))}}));
    const double pixels = (7 * 0.5 + 8 + 9 + 10 + 11 * 0.25) / 3.75,
                 level = (6.5 * 0.25 + 8.5 + 10.5 * 0.625) / 1.875;
    expectPixel(between, 2, 1, {0, (pixels + level) / 2 * 16 / 255, 0, 1}, 1e-6);
    // So small that there is one texel.
    const auto tiny = draw(sceneOf({{fillAll(greens(ImageFilter::Bicubic, 1.0 / 64, ramp))}}));
    expectPixel(tiny, 4, 4, {0, 7.5 * 16 / 255, 0, 1}, 1e-6);
}

TEST_P(Paints, BicubicImagesRunThroughQuadratics) {
    const auto parabola = [](int x, int) { return x * x; };
    const auto raster = draw(sceneOf({{fillAll(greens(ImageFilter::Bicubic, 1.6, parabola))}}));
    for (const int x : {3, 4, 5, 6}) {
        const double at = (x + 0.5) / 1.6 - 0.5;
        expectPixel(raster, x, 3, {0, at * at / 255, 0, 1}, 1e-6);
    }
}

/// Beside an edge the cubic leaves [0, 255].
TEST_P(Paints, BicubicImagesStayColours) {
    const auto edge = [](int x, int) { return x < 4 ? 0 : 255; };
    const auto raster = draw(sceneOf({{fillAll(greens(ImageFilter::Bicubic, 1.25, edge))}}));
    for (int x = 0; x < 8; ++x) {
        const float green = raster.pixel(x, 3)[1];
        EXPECT_TRUE(green >= 0 && green <= 1) << x;
    }
    expectPixel(raster, 3, 3, {0, 0, 0, 1}, 1e-6);
    expectPixel(raster, 6, 3, {0, 1, 0, 1}, 1e-6);
}

TEST_P(Paints, MagnifiedTrilinearIsBilinearAtThePixelsCentre) {
    const auto raster = draw(sceneOf({{fillAll(picture(ImageFilter::Trilinear))}}));
    expectPixel(raster, 1, 1, {0.5625, 0.1875, 0.1875, 0.9375}, 1e-6);
    expectPixel(raster, 0, 0, {1, 0, 0, 1}, 1e-6);
}

TEST(Materials, AreTheCallersOrTheirFallback) {
    const Material material{"a", "", {1, 0, 0, 0.5f}, scaling(2, 2)};
    const Scene scene = sceneOf({{fillAll(material, 0.5f)}});
    for (const Mode mode : {Mode::Exact, Mode::Compat}) {
        Options options{mode, 32};
        expectPixel(render(scene, {8, 8}, options), 3, 3, {0.25, 0, 0, 0.25});
        options.materials = [](const scene::Material& m, Point p) {
            return glm::dvec4(m.fallback.r, p.x / 10, p.y / 10, 1);
        };
        expectPixel(render(scene, {8, 8}, options), 3, 5, {0.5, 0.0875, 0.1375, 0.5});
    }
}

}  // namespace
}  // namespace vtm::reference
