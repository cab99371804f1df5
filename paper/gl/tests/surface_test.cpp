// Paper mode on surfaces in perspective (rows 7 and 12): against its twin on the CPU with each pixel's own
// footprint, and against means over the pixels.

#include "paper/gl/surface.hpp"

#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>
#include <glm/common.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include "backend_gl/tests/gl_fixture.hpp"
#include "paper/compile.hpp"
#include "paper/evaluate.hpp"
#include "paper/gl/pattern.hpp"
#include "paper/gl/renderer.hpp"

namespace vtm::paper {

using namespace gl;
namespace {

using glm::dvec2;
using glm::vec2;

constexpr int side = 96;
constexpr double pi = std::numbers::pi;

// ---- Pictures -------------------------------------------------------------------------------------------

scene::Node filled(scene::Path path, const scene::Paint& paint) {
    return {scene::Item{std::make_shared<const scene::Path>(std::move(path)), scene::identity,
                        scene::FillRule::NonZero, paint, 1}};
}

scene::Path disc(scene::Point centre, double radius) {
    const scene::Point left = centre - scene::Point(radius, 0), right = centre + scene::Point(radius, 0);
    return {scene::MoveTo{left}, scene::ArcTo{{radius, radius}, 0, false, true, right},
            scene::ArcTo{{radius, radius}, 0, false, true, left}, scene::Close{}};
}

/// A disc and a kite on a ground that covers the picture, and a gradient: opaque everywhere.
CompileResult opaqueSign() {
    scene::LinearGradient across;
    across.start = {20, 0};
    across.end = {80, 0};
    across.stops = {{0, {0.9f, 0.1f, 0.1f, 1}}, {1, {0.2f, 0.1f, 0.7f, 1}}};
    scene::Scene scene{100, 100, {}};
    scene.root.children = {
        filled(scene::rectangle({0, 0}, {100, 100}), scene::Color{0.9f, 0.9f, 0.6f, 1}),
        filled(disc({50, 50}, 34), across),
        filled(scene::polygon({{50, 22}, {70, 55}, {50, 70}, {30, 55}}), scene::Color{0.1f, 0.6f, 0.3f, 1})};
    return compile(scene);
}

// ---- Surfaces -------------------------------------------------------------------------------------------

/// From a point of the raster to (s, t).
using Place = std::function<dvec2(dvec2)>;

/// A floor: t grows to the horizon, which is at the raster's upper border, and s is 0 in the middle.
dvec2 onFloor(dvec2 pixel) {
    const double depth = side / pixel.y;
    return {(pixel.x / side - 0.5) * 3 * depth, 2 * depth};
}

/// From row `top` of the raster to its last one.
Surface floorFrom(double top) {
    Surface surface;
    for (const dvec2 corner : {dvec2(0, top), dvec2(side, top), dvec2(0, side), dvec2(side, side)}) {
        const double w = side / corner.y;
        const dvec2 clip = (corner / (0.5 * side) - 1.0) * w;
        surface.vertices.push_back({{clip, 0, w}, onFloor(corner)});
    }
    surface.triangles = {0, 1, 2, 2, 1, 3};
    return surface;
}

constexpr double radius = 0.48 * side;

dvec2 onSphere(dvec2 pixel) {
    const dvec2 p = (pixel - 0.5 * side) / radius;
    return dvec2(std::atan2(p.x, std::sqrt(std::max(1 - glm::dot(p, p), 0.0))), std::asin(p.y)) * 2.0 / pi;
}

/// The half that is seen.
Surface sphere() {
    constexpr int steps = 128;
    Surface surface;
    for (int j = 0; j <= steps; ++j)
        for (int i = 0; i <= steps; ++i) {
            const dvec2 st = dvec2(i, j) * 2.0 / double(steps) - 1.0, angle = 0.5 * pi * st;
            const dvec2 p(std::cos(angle.y) * std::sin(angle.x), std::sin(angle.y));
            surface.vertices.push_back({{p * radius / (0.5 * side), 0, 1}, st});
        }
    for (std::uint32_t j = 0; j < steps; ++j)
        for (std::uint32_t i = 0; i < steps; ++i) {
            const std::uint32_t at = j * (steps + 1) + i, below = at + steps + 1;
            for (const std::uint32_t corner : {at, at + 1, below, below, at + 1, below + 1})
                surface.triangles.push_back(corner);
        }
    return surface;
}

/// The picture's plane to pixels, to first order.
glm::dmat2 toPixelsAt(const Place& place, dvec2 pixel) {
    constexpr double step = 1e-4;
    return glm::inverse(
        glm::dmat2((place(pixel + dvec2(step, 0)) - place(pixel - dvec2(step, 0))) / (2 * step),
                   (place(pixel + dvec2(0, step)) - place(pixel - dvec2(0, step))) / (2 * step)));
}

/// Visits the middles of pixels that lie on the surface with all their neighbours.
template <class Visit>
void forEachPixel(const std::function<bool(dvec2)>& isOn, Visit&& visit) {
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            bool all = true;
            for (const dvec2 corner : {dvec2(-1, -1), dvec2(2, -1), dvec2(-1, 2), dvec2(2, 2)})
                all = all && isOn(dvec2(x, y) + corner);
            if (all)
                visit(x, y);
        }
}

constexpr double top = 4;
bool isOnFloor(dvec2 p) { return p.x >= 0 && p.y >= top && p.x <= side && p.y <= side; }
bool isOnSphere(dvec2 p) { return glm::distance(p, dvec2(0.5 * side)) < radius; }

// ---- Tests ----------------------------------------------------------------------------------------------

using Surfaces = Gl;

struct Seen {
    const char* name;
    Surface surface;
    Place place;
    std::function<bool(dvec2)> isOn;
};

std::vector<Seen> everySurface() {
    return {{"floor", floorFrom(top), onFloor, isOnFloor}, {"sphere", sphere(), onSphere, isOnSphere}};
}

TEST_F(Surfaces, ShowWhatTheTwinShowsWithEachPixelsFootprint) {
    Renderer paper;
    const Asset asset = opaqueSign().asset;
    const Texture texture(asset);
    for (const Seen& seen : everySurface()) {
        const image::Raster drawn = paper.render(texture, seen.surface, {side, side});
        double squares = 0, count = 0;
        forEachPixel(seen.isOn, [&](int x, int y) {
            const dvec2 pixel(x + 0.5, y + 0.5), st = seen.place(pixel);
            const Footprint footprint(toPixelsAt(seen.place, pixel) / asset.width);
            const Sample expected = sampleRepeated(asset, (st - glm::floor(st)) * asset.width, footprint);
            ASSERT_NEAR(drawn.pixel(x, y)[3], 1, 1e-3) << seen.name << ": " << x << ", " << y;
            for (int c = 0; c < 3; ++c)
                squares += std::pow(drawn.pixel(x, y)[c] - expected.color[c], 2) / 3;
            ++count;
        });
        EXPECT_GT(count, 4000);
        // Derivatives are differences within blocks of 2 x 2 pixels.
        EXPECT_LE(255 * std::sqrt(squares / count), 4) << seen.name;
    }
}

/// Of pixels by 32 x 32 samples.
TEST_F(Surfaces, PatternsAreNearerToTheirMeansWithFilters) {
    const Mask mask = opaqueSign().asset.masks.at(0);
    const auto isInside = [&](dvec2 st) {
        return classify(mask, dvec2(mask.x, mask.y) + (st - glm::floor(st)) * mask.side);
    };
    for (const Seen& seen : everySurface()) {
        const UploadedSurface uploaded(seen.surface);
        double squares[2] = {}, count = 0;
        const image::Raster drawn[2] = {Pattern(mask, {true, true, false}).render(uploaded, {side, side}),
                                        Pattern(mask, {true, false, false}).render(uploaded, {side, side})};
        forEachPixel(seen.isOn, [&](int x, int y) {
            if ((x + 2 * y) % 5 != 0)
                return;
            constexpr int samples = 32;
            double truth = 0;
            for (int i = 0; i < samples * samples; ++i)
                truth += isInside(
                    seen.place(dvec2(x, y) + (dvec2(i % samples, i / samples) + 0.5) / double(samples)));
            truth /= samples * samples;
            for (int i = 0; i < 2; ++i)
                squares[i] += std::pow(drawn[i].pixel(x, y)[3] - truth, 2);
            ++count;
        });
        const double filtered = 255 * std::sqrt(squares[0] / count),
                     unfiltered = 255 * std::sqrt(squares[1] / count);
        // The filter is as wide as the longer side of a pixel, so it is soft where a surface is seen at an
        // angle.
        EXPECT_LE(filtered, 0.75 * unfiltered) << seen.name;
    }
}

/// Where a mask's borders are far enough for its mip to be the pattern's.
TEST_F(Surfaces, PatternsBlendTheLevelsOfTheTwin) {
    const Mask mask = opaqueSign().asset.masks.at(0);
    const image::Raster drawn = Pattern(mask, {}).render(UploadedSurface(floorFrom(top)), {side, side});
    double squares = 0, count = 0;
    int blended = 0;
    forEachPixel(isOnFloor, [&](int x, int y) {
        const dvec2 pixel(x + 0.5, y + 0.5), st = onFloor(pixel), uv = st - glm::floor(st);
        const Footprint footprint(toPixelsAt(onFloor, pixel) / mask.side);
        const double lod = std::log2(footprint.longer / mask.side) + mask.mip.sizeLog2;
        if (lod > 3 || std::max(std::abs(uv.x - 0.5), std::abs(uv.y - 0.5)) > 0.35)
            return;
        Cost cost;
        const double expected = maskCoverage(mask, dvec2(mask.x, mask.y) + uv * mask.side, footprint, cost);
        squares += std::pow(drawn.pixel(x, y)[3] - expected, 2);
        ++count;
        blended += cost.mips == 2;
    });
    EXPECT_GT(blended, 500);
    EXPECT_LE(255 * std::sqrt(squares / count), 2.5);
}

TEST_F(Surfaces, PatternsAreTheirMeanFarAway) {
    const Mask mask = opaqueSign().asset.masks.at(0);
    Surface floor = floorFrom(1);
    for (Surface::Vertex& vertex : floor.vertices)
        vertex.st *= 64;
    const image::Raster drawn = Pattern(mask, {}).render(UploadedSurface(floor), {side, side});
    for (int x = 0; x < side; ++x)
        EXPECT_NEAR(drawn.pixel(x, side / 4)[3], mask.mip.texels.back() / 255.0, 3.0 / 255);
}

TEST_F(Surfaces, PicturesAreTheirMeanFarAway) {
    Renderer paper;
    scene::Scene scene{100, 100, {}};
    scene.root.children = {filled(scene::rectangle({0, 0}, {100, 100}), scene::Color{1, 0, 0, 1}),
                           filled(scene::rectangle({20, 10}, {70, 60}), scene::Color{0, 0, 1, 1})};
    Surface floor = floorFrom(1);
    for (Surface::Vertex& vertex : floor.vertices)
        vertex.st *= 64;
    const image::Raster drawn = paper.render(Texture(compile(scene).asset), floor, {side, side});
    for (int x = 0; x < side; ++x) {
        EXPECT_NEAR(drawn.pixel(x, side / 4)[0], 0.75, 3.0 / 255);
        EXPECT_NEAR(drawn.pixel(x, side / 4)[2], 0.25, 3.0 / 255);
    }
}

TEST_F(Surfaces, AFlatSurfaceIsAView) {
    Renderer paper;
    const Asset asset = opaqueSign().asset;
    const Texture texture(asset);
    Surface flat;
    for (const vec2 st : {vec2(0, 0), vec2(1, 0), vec2(0, 1), vec2(1, 1)})
        flat.vertices.push_back({{2.0f * st - 1.0f, 0, 1}, st});
    flat.triangles = {0, 1, 2, 2, 1, 3};
    const image::Raster surface = paper.render(texture, flat, {side, side}),
                        view = paper.render(
                            texture, asset::View{side, side, {side / 100.0, 0, 0, side / 100.0, 0, 0}});
    for (std::size_t c = 0; c < view.rgba.size(); ++c)
        ASSERT_NEAR(surface.rgba[c], view.rgba[c], 2.0f / 255) << c / 4 % side << ", " << c / 4 / side;
}

TEST_F(Surfaces, BadOnesAreRefused) {
    Renderer paper;
    const Asset asset = opaqueSign().asset;
    const Texture texture(asset);
    Surface surface = floorFrom(top);
    EXPECT_THROW(paper.render(texture, surface, {0, side}), std::length_error);
    EXPECT_THROW(paper.render(texture, surface, {side, 1 << 20}), std::length_error);
    surface.triangles.back() = 4;
    EXPECT_THROW(paper.render(texture, surface, {side, side}), std::invalid_argument);
    surface.triangles.resize(5);
    EXPECT_THROW(UploadedSurface{surface}, std::invalid_argument);
    for (const float channel : paper.render(texture, Surface{}, {side, side}).rgba)
        ASSERT_EQ(channel, 0);
}

}  // namespace
}  // namespace vtm::paper
