// Cells whose pieces take more turns of loops than a driver allows: their pixels come from the scanner, into
// every output, and look like the others.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <vtm/compiler/compile.hpp>
#include <vtm/raster/scan.hpp>
#include "asset/testing.hpp"
#include "backend_gl/core/gl.hpp"
#include "backend_gl/core/turns.hpp"
#include "backend_gl/tests/gl_fixture.hpp"
#include "raster/testing_views.hpp"

namespace vtm::gl {
namespace {

using asset::Asset;
using asset::View;
using image::Raster;
using namespace asset::test;

/// Nothing but what has no pieces near it is left to shaders.
constexpr unsigned noTurns = 1;
/// More than any driver has.
constexpr unsigned allTurns = 1u << 30;

RendererOptions withTurns(unsigned turns, bool mark = false) {
    RendererOptions options;
    options.pixels = Pixels::Shaders;
    options.maxTurns = turns;
    options.markOverruns = mark;
    return options;
}

double worst(const Raster& a, const Raster& b) {
    double difference = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i)
        difference = std::max(difference, 255 * double(std::abs(a.rgba[i] - b.rgba[i])));
    return difference;
}

/// Triangles of alternating colours with a common corner, opaque all round.
Asset fan(int count) {
    scene::Scene scene;
    scene.width = scene.height = 64;
    const auto at = [&](int i) {
        const double angle = 2 * std::numbers::pi * i / count;
        return scene::Point{32 + 60 * std::cos(angle), 32 + 60 * std::sin(angle)};
    };
    for (int i = 0; i < count; ++i) {
        scene::Item item;
        item.path = std::make_shared<scene::Path>(scene::Path{scene::MoveTo{{32, 32}}, scene::LineTo{at(i)},
                                                              scene::LineTo{at(i + 1)}, scene::Close{}});
        item.paint = scene::Color{float(i % 2), float(i % 3) / 2, float(i % 5) / 4, 1};
        scene.root.children.push_back({item});
    }
    return compiler::compile(scene).asset;
}

/// Of parts of pixels in which paints turn the scanner knows first moments, shaders quarters: either is off
/// by about a sixteenth of what the quarters differ by. With a material no pixel is drawn finer, so that they
/// may differ by everything (docs/coverage.md).
TEST_F(Gl, CrowdedCellsLookLikeOthers) {
    Renderer crowded(withTurns(noTurns));
    for (const Asset& asset : {halfPlane(), threeRegions(), disc(), twoLevels(), everyPaint()})
        for (const double angle : {0.0, 0.7, 2.5})
            for (const double zoom : {0.3, 2.0, 11.0}) {
                const View view = turnedView(60, 50, {30, 34}, zoom, angle, 0.2, angle > 1);
                const Texture a = crowded.upload(asset), b = renderer->upload(asset);
                const bool mayTurnInPixels = !asset.materials.empty() && zoom < 1;
                EXPECT_LE(worst(crowded.render(a, view), renderer->render(b, view)),
                          mayTurnInPixels ? 255.0 / 16 : 2)
                    << angle << ' ' << zoom;
            }
}

/// Where shaders would not suffice, too.
TEST_F(Gl, CrowdedCellsAreScanned) {
    Renderer crowded(withTurns(noTurns));
    for (const Asset& asset : {everyPaint(), blendAsset(asset::Blend::Hue)})
        for (const double zoom : {0.3, 2.0, 11.0}) {
            const View view = turnedView(60, 50, {30, 34}, zoom, 0.7, 0.2);
            const image::Raster scanned = asset::Scanner(asset).draw(view);
            EXPECT_LE(worst(crowded.render(crowded.upload(asset), view), scanned), 2) << zoom;
        }
}

/// The turned view, `ratio` times as large along an axis that is turned by `axis`.
View stretchedView(double ratio, double axis) {
    View view = turnedView(60, 50, {30, 34}, 0.9, 0.4);
    const glm::dvec2 along(std::cos(axis), std::sin(axis)), middle(30, 25);
    const auto stretched = [&](glm::dvec2 v) { return v + (ratio - 1) * glm::dot(v, along) * along; };
    for (int column : {0, 1})
        view.toPixels[column] = stretched(view.toPixels[column]);
    view.toPixels[2] = middle + stretched(view.toPixels[2] - middle);
    return view;
}

/// Tiles are as fine as the smaller stretch asks for; beyond maxStretchRatio the scanner draws.
TEST_F(Gl, StretchedViewsAreExact) {
    for (const Asset& asset : {halfPlane(), threeRegions(), disc(), twoLevels()}) {
        const Texture texture = renderer->upload(asset);
        const asset::Scanner scanner(asset);
        for (const double ratio : {1.5, 2.9, 3.1, 10.0, 300.0, 1e5})
            for (const double axis : {0.0, 0.6, 1.6, 2.9}) {
                const View view = stretchedView(ratio, axis);
                EXPECT_LE(worst(renderer->render(texture, view), scanner.draw(view)), 4)
                    << ratio << ' ' << axis;
            }
    }
}

TEST_F(Gl, CrowdedCellsGoIntoEveryOutput) {
    Renderer crowded(withTurns(noTurns));
    const Asset asset = disc();
    const Texture a = crowded.upload(asset), b = renderer->upload(asset);
    const View view = turnedView(60, 50, {30, 34}, 0.9, 0.4);
    for (const GLenum format : {GL_RGBA8, GL_SRGB8_ALPHA8})
        for (int variant = 0; variant < 64; ++variant) {
            Output output;
            const auto has = [&](int bit) { return (variant >> bit & 1) != 0; };
            output.firstRow = has(0) ? Output::FirstRow::Top : Output::FirstRow::Bottom;
            output.alpha = has(1) ? Output::Alpha::Straight : Output::Alpha::Premultiplied;
            output.encoding = has(2) ? Output::Encoding::Linear : Output::Encoding::Srgb;
            output.linearLight = has(3);
            output.dither = has(4);
            output.write = has(5) && !has(1) ? Output::Write::Over : Output::Write::Replace;
            if (has(0))
                output.damage = {{3, 4, 20, 30}, {40, 10, 7, 9}};
            output.x = 5;
            const UserFramebuffer first(format, 70, 50, {0.2f, 0.4f, 0.6f, 1});
            crowded.draw(a, view, output);
            const UserFramebuffer second(format, 70, 50, {0.2f, 0.4f, 0.6f, 1});
            renderer->draw(b, view, output);
            const std::vector<std::uint8_t> x = first.bytes(), y = second.bytes();
            int difference = 0;
            for (std::size_t i = 0; i < x.size(); ++i)
                difference = std::max(difference, x[(i | 3)] < 32 ? 0 : std::abs(int(x[i]) - int(y[i])));
            EXPECT_LE(difference, output.alpha == Output::Alpha::Straight ? 16 : 6)
                << format << ' ' << variant;
        }
}

TEST_F(Gl, CrowdedCellsOfSeveralMapsAddUp) {
    Renderer crowded(withTurns(noTurns));
    Asset asset = disc();
    asset.commands.push_back(asset.commands.front());
    const View view = turnedView(60, 50, {30, 34}, 0.9, 0.4);
    EXPECT_LE(
        worst(crowded.render(crowded.upload(asset), view), renderer->render(renderer->upload(asset), view)),
        2);
}

/// Petals of two colours, many to a pixel in the middle of the picture and few near its border.
Asset petals() {
    scene::Scene scene;
    scene.width = scene.height = 64;
    for (int i = 0; i < 1500; ++i) {
        const double radius = 0.8 * std::sqrt(i), angle = 2.4 * i, size = 0.1 + 0.02 * radius;
        const scene::Point at(32 + radius * std::cos(angle), 32 + radius * std::sin(angle));
        scene::Item item;
        item.path = std::make_shared<scene::Path>(scene::Path{
            scene::MoveTo{at},
            scene::CubicTo{at + scene::Point(size, 0), at + scene::Point(size, size),
                           at + scene::Point(0, size)},
            scene::CubicTo{at + scene::Point(-size, size), at + scene::Point(-size, 0), at}, scene::Close{}});
        item.paint = i % 2 == 0 ? scene::Color{1, 0.2f, 0, 1} : scene::Color{0, 0.3f, 1, 0.5f};
        scene.root.children.push_back({item});
    }
    return compiler::compile(scene).asset;
}

/// Tiles have more and smaller cells where lists are long: at some of these scales all three grids occur.
TEST_F(Gl, ManySmallPiecesAreExact) {
    const Asset asset = petals();
    const Texture texture = renderer->upload(asset);
    const asset::Scanner scanner(asset);
    for (const double zoom : {0.11, 0.4, 0.73, 1.0, 1.9, 3.3, 7.7})
        for (const double angle : {0.0, 0.6, 2.1}) {
            const View view = turnedView(90, 80, {32, 32}, zoom, angle, 0, angle > 2);
            EXPECT_LE(worst(renderer->render(texture, view), scanner.draw(view)), 2) << zoom << ' ' << angle;
        }
}

bool isMagenta(const float* pixel) {
    return pixel[0] == 1 && pixel[1] == 0 && pixel[2] == 1 && pixel[3] == 1;
}

/// What a shader makes that is stopped by the driver, and that with the turns that are allowed none is.
TEST_F(Gl, OverrunsAreMarkedAndNeverTransparent) {
    if (std::string(reinterpret_cast<const char*>(glGetString(GL_RENDERER))).find("llvmpipe") ==
        std::string::npos)
        GTEST_SKIP() << "the driver does not stop loops";
    constexpr int side = 24;  // about the fan's middle
    const Asset asset = fan(9000);
    const View view = turnedView(side, side, {32, 32}, 1, 0);
    const auto draw = [&](unsigned turns, bool mark) {
        Renderer drawing(withTurns(turns, mark));
        return drawing.render(drawing.upload(asset), view);
    };
    const Raster marked = draw(allTurns, true), filled = draw(allTurns, false), right = draw(0, true);
    int magenta = 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            magenta += isMagenta(marked.pixel(x, y));
            EXPECT_FALSE(isMagenta(filled.pixel(x, y)) || isMagenta(right.pixel(x, y)));
            EXPECT_NEAR(filled.pixel(x, y)[3], 1, 1e-3) << x << ", " << y;
            EXPECT_NEAR(right.pixel(x, y)[3], 1, 1e-3) << x << ", " << y;
        }
    EXPECT_GT(magenta, 0);
}

}  // namespace
}  // namespace vtm::gl
