// Pictures full of gradients on surfaces that are seen up to their horizon: a floor, a sphere up to its
// outline, a tube up to its far end. There footprints grow without limit, so nothing may be missing, and
// every pixel is compared with the mean over its area (docs/texture.md).

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <vtm/compiler/compile.hpp>
#include <vtm/raster/scan.hpp>
#include "backend_gl/testing.hpp"
#include "conformance/cases/support.hpp"
#include "conformance/cases/texture_views.hpp"

namespace vtm::cases {
namespace {

namespace fs = std::filesystem;
using glm::dvec2;
using image::Raster;

constexpr gl::Wrapping repeated{asset::Wrap::Repeat, asset::Wrap::Repeat};
constexpr double pi = std::numbers::pi;

// ---- Surfaces -----------------------------------------------------------------------------------------

constexpr int side = 96;

/// (s, t) at a point of the raster, that lies on the surface.
using Place = std::function<dvec2(dvec2)>;
using OnSurface = std::function<bool(dvec2)>;

dvec2 fromMiddle(dvec2 pixel) { return (pixel - side * 0.5) / (side * 0.48); }

dvec2 onSphere(dvec2 pixel) {
    const dvec2 p = fromMiddle(pixel);
    return dvec2(std::atan2(p.x, std::sqrt(std::max(1 - glm::dot(p, p), 0.0))), std::asin(p.y)) * 2.0 / pi;
}

dvec2 inTube(dvec2 pixel) {
    const dvec2 p = fromMiddle(pixel);
    return {std::atan2(p.y, p.x) / pi, 0.5 / std::max(glm::length(p), 1e-6)};
}

/// The same in a shader, with the footprint's sides. `toPicture`: 1 if it is the tube.
constexpr const char* placesText = R"(
uniform Vtm picture;
uniform mat3 toPicture;
const float pi = 3.14159265;
vec2 placeOf(vec2 pixel) {
    vec2 p = (pixel - 48.0) / 46.08;
    if (toPicture[0].x == 1.0)
        return vec2(atan(p.y, p.x) / pi, 0.5 / max(length(p), 1e-6));
    return vec2(atan(p.x, sqrt(max(1.0 - dot(p, p), 0.0))), asin(clamp(p.y, -1.0, 1.0))) * 2.0 / pi;
}
vec2 sideOf(vec2 pixel, vec2 halfSide) {
    vec2 d = placeOf(pixel + halfSide) - placeOf(pixel - halfSide);
    return vec2(d.x - 2.0 * floor(d.x / 2.0 + 0.5), d.y);  // around the tube s grows by 2
}
vec4 shade(vec2 pixel) {
    return vtm_sample_grad(picture, placeOf(pixel), sideOf(pixel, vec2(0.5, 0.0)), sideOf(pixel, vec2(0.0, 0.5)));
})";

// ---- The truth ----------------------------------------------------------------------------------------

glm::dvec4 colorAt(const Raster& picture, dvec2 st) {
    const dvec2 place = (st - glm::floor(st)) * dvec2(picture.width, picture.height);
    const float* pixel =
        picture.pixel(std::min(int(place.x), picture.width - 1), std::min(int(place.y), picture.height - 1));
    return {pixel[0], pixel[1], pixel[2], pixel[3]};
}

/// The mean over a pixel, by 64 samples along each side.
glm::dvec4 meanOf(const Raster& picture, const Place& place, int x, int y) {
    constexpr int samples = 64;
    glm::dvec4 sum(0);
    for (int i = 0; i < samples; ++i)
        for (int j = 0; j < samples; ++j)
            sum += colorAt(picture, place(dvec2(x, y) + (dvec2(j, i) + 0.5) / double(samples)));
    return sum / double(samples * samples);
}

/// Whether all of a pixel lies on the surface.
bool isInside(const OnSurface& isOn, int x, int y) {
    for (const dvec2 corner : {dvec2(0, 0), dvec2(1, 0), dvec2(0, 1), dvec2(1, 1)})
        if (!isOn(dvec2(x, y) + corner))
            return false;
    return true;
}

/// A pixel has at least this share of its true alpha, but for what is hardly seen: the prefilter sees a
/// little more than the pixel's area, of an outline two thirds. Opaque pictures stay opaque.
constexpr double leastShare = 0.5, hardlySeen = 8.0 / 255, opaque = 254.5 / 255;
constexpr double maxRms = 3;  // in 1/255

bool isOpaque(const Raster& picture) {
    for (std::size_t i = 3; i < picture.rgba.size(); i += 4)
        if (picture.rgba[i] < opaque)
            return false;
    return true;
}

/// A fifth of the pixels, in a pattern that meets all rows and columns.
bool isCompared(int x, int y) { return (x + 2 * y) % 5 == 0; }

void expectTrue(const std::string& name, const Raster& drawn, const Raster& picture, const Place& place,
                const OnSurface& isOn) {
    double squares = 0, count = 0;
    const double leastAlpha = isOpaque(picture) ? opaque : 0;
    for (int y = 0; y < drawn.height; ++y)
        for (int x = 0; x < drawn.width; ++x) {
            if (!isInside(isOn, x, y))
                continue;
            const float* pixel = drawn.pixel(x, y);
            ASSERT_GE(pixel[3], leastAlpha) << name << ": " << x << ", " << y;
            if (!isCompared(x, y))
                continue;
            const glm::dvec4 truth = meanOf(picture, place, x, y),
                             off = glm::dvec4(pixel[0], pixel[1], pixel[2], pixel[3]) - truth;
            ASSERT_GE(pixel[3], leastShare * truth.a - hardlySeen) << name << ": " << x << ", " << y;
            squares += glm::dot(off, off) / 4;
            ++count;
        }
    const double rms = 255 * std::sqrt(squares / count);
    EXPECT_LE(rms, maxRms) << name;
    testing::Test::RecordProperty(name, fmt::format("{:.2f}", rms));
}

// ---- Pictures -----------------------------------------------------------------------------------------

class TexturedSurface : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Of, TexturedSurface,
                         testing::Values("lighthouse", "rose_window", "planet", "gauge", "blend",
                                         "noto_people", "noto_gorilla", "gallardo", "fluent_prince",
                                         "flag_mx"),
                         [](const auto& tested) { return std::string(tested.param); });

TEST_P(TexturedSurface, IsRightUpToItsHorizon) {
    const std::string file = std::string(GetParam()) + ".svg";
    const fs::path own = examplesDirectory() / file, real = sharedDirectory() / "corpus" / file;
    if (!fs::exists(own) && !fs::exists(real))
        GTEST_SKIP() << real << " is absent";
    const scene::Scene scene = loadScene(fs::exists(own) ? own : real);
    const asset::Asset asset = compiler::compile(scene, {.filterPixels = 1024}).asset;
    const Raster picture = asset::Scanner(asset).draw(wholePicture(scene, 1024));
    const Gl gl;

    constexpr Floor floor{160, 64, 120, 1.5};
    const glm::dmat3 toPicture = floor.toPicture(1);
    gl::test::TextureCanvas floorCanvas(asset);
    expectTrue(
        "floor", floorCanvas.draw(toPicture, floor.width, floor.height, repeated), picture,
        [&](dvec2 pixel) {
            const glm::dvec3 p = toPicture * glm::dvec3(pixel, 1);
            return dvec2(p) / p.z;
        },
        [](dvec2) { return true; });

    gl::SampledTexture texture(asset);
    gl::test::ShaderCanvas canvas(gl::sampleInclude({asset}), placesText);
    const auto drawn = [&](bool isTube) {
        texture.bind(canvas.program(), "picture", 0, repeated);
        canvas.set("toPicture", glm::dmat3(isTube ? 1.0 : 0.0));
        return canvas.draw(side, side);
    };
    expectTrue("sphere", drawn(false), picture, onSphere,
               [](dvec2 pixel) { return glm::length(fromMiddle(pixel)) < 1; });
    expectTrue("tube", drawn(true), picture, inTube, [](dvec2) { return true; });
}

}  // namespace
}  // namespace vtm::cases
