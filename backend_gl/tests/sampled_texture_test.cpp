// Assets as textures in a user's shader, against the CPU evaluator: everywhere in the plane, alone and
// together.
#include <vtm/gl/sampled_texture.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <vtm/asset/container.hpp>
#include <vtm/asset/placements.hpp>
#include <vtm/raster/evaluate.hpp>
#include "asset/testing.hpp"
#include "backend_gl/core/gl.hpp"
#include "backend_gl/testing.hpp"
#include "backend_gl/tests/gl_fixture.hpp"
#include "raster/testing_prefilter.hpp"
#include "raster/testing_views.hpp"

namespace vtm::gl {
namespace {

using asset::Asset;
using asset::View;
using asset::Wrap;
using image::Raster;
using namespace asset::test;

/// Placing by single precision (s, t) and what the evaluator differs from the GPU by: docs/texture.md.
constexpr double tolerance = 2.0 / 255;

Raster drawn(const Asset& asset, const View& view, Wrapping wrapping = {}) {
    return test::TextureCanvas(asset).draw(view, wrapping);
}

double worst(const Raster& a, const Raster& b) {
    EXPECT_EQ(a.rgba.size(), b.rgba.size());
    double difference = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i)
        difference = std::max(difference, double(std::abs(a.rgba[i] - b.rgba[i])));
    return difference;
}

/// Turned, mirrored and sheared, at least a pixel a unit, so that nothing is minified.
View largeView(std::mt19937& random) {
    std::uniform_real_distribution<double> unit(0, 1);
    const glm::dvec2 centre(64 * unit(random), 64 * unit(random));
    return turnedView(40, 30, centre, std::exp2(6 * unit(random)), 6.28 * unit(random), unit(random) - 0.5,
                      unit(random) < 0.5);
}

TEST_F(Gl, TexturesShowWhatTheEvaluatorDoes) {
    std::mt19937 random(1);
    for (const Asset& asset : {halfPlane(), wedge(), strip(), threeRegions(), disc(), twoLevels(),
                               blendAsset(asset::Blend::Normal), blendAsset(asset::Blend::Hue)})
        for (test::TextureCanvas canvas(asset); const int i : {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}) {
            const View view = largeView(random);
            EXPECT_LE(worst(canvas.draw(view), asset::evaluateAsShaders(asset, view)), tolerance) << i;
        }
}

TEST_F(Gl, TexturesHaveEveryPaint) {
    const Asset asset = everyPaint();
    test::TextureCanvas canvas(asset);
    for (int i = 0; i < 16; ++i) {  // large, so that it does not matter where in a pixel a paint is looked at
        const View view = turnedView(96, 96, {8 + 16 * (i % 4), 8 + 16 * (i / 4)}, 40, 0.5);
        const Raster picture = asset::evaluateAsShaders(asset, view);
        EXPECT_LE(worst(canvas.draw(view), picture), tolerance) << i;
        EXPECT_GT(worst(picture, Raster(96, 96)), 0.1) << i;
    }
}

/// What copies of the picture show, each transparent outside itself, is their sum.
Raster sumOfCopies(const Asset& asset, const View& view, bool mirrored, int from, int to) {
    Raster sum(view.width, view.height);
    for (int y = from; y <= to; ++y)
        for (int x = from; x <= to; ++x) {
            const glm::dvec2 size(asset.width, asset.height);
            const glm::bvec2 flipped(mirrored && x % 2 != 0, mirrored && y % 2 != 0);
            const glm::dvec2 sign(flipped.x ? -1 : 1, flipped.y ? -1 : 1);
            const glm::dvec2 origin = glm::dvec2(x + (flipped.x ? 1 : 0), y + (flipped.y ? 1 : 0)) * size;
            View copy = view;
            copy.toPixels = glm::dmat3x2(view.toPixels[0] * sign.x, view.toPixels[1] * sign.y,
                                         view.toPixels * glm::dvec3(origin, 1));
            const Raster part = asset::evaluate(asset, copy);
            std::ranges::transform(sum.rgba, part.rgba, sum.rgba.begin(), std::plus());
        }
    return sum;
}

TEST_F(Gl, TexturesSayWhatTheyTake) {
    const Asset small = halfPlane(), more = twoLevels();
    const std::size_t few = SampledTexture(small).bytes();
    const asset::Prefilter coarse = asset::buildPrefilter(small);
    const std::size_t means = coarse.size.texelsBefore(coarse.size.levels()) * 4;
    EXPECT_GE(few, means + small.pieces.size() * sizeof(asset::Texel));
    EXPECT_LE(few, means + (std::size_t(2) << 12) * sizeof(asset::Texel));  // a row of records or two
    EXPECT_GT(SampledTexture(more, {.squaresPerFootprint = 1.2}).bytes(), SampledTexture(more).bytes());
}

TEST_F(Gl, RepeatedAndMirroredTexturesHaveNoSeam) {
    Asset slanting = halfPlane();
    slanting.height = 48;  // the square goes on below the picture: cut it off
    slanting.maps[0].root =
        addLeaf(slanting, {1, 2, 0, 0},
                {line({20001, 0}, {30002, 49151}, 1, 2), line({30002, 49151}, {0, 49151}, 1, 0),
                 line({65535, 49151}, {30002, 49151}, 2, 0)});
    ASSERT_NO_THROW(asset::validate(slanting));
    for (const Asset& asset : {slanting, disc()})
        for (const bool mirrored : {false, true}) {
            const Wrap wrap = mirrored ? Wrap::Mirror : Wrap::Repeat;
            for (const double zoom : {0.9, 3.0, 20.0}) {
                const View view = turnedView(50, 40, {0.3, 0.2}, zoom, 0.3, 0.2);
                EXPECT_LE(worst(drawn(asset, view, {wrap, wrap}), sumOfCopies(asset, view, mirrored, -2, 1)),
                          tolerance)
                    << mirrored << ' ' << zoom;
            }
        }
}

asset::Entry solidOf(std::uint32_t paint) { return asset::Entry::make(asset::Entry::Kind::Solid, paint); }

/// Most squares are red, which lies under footprints inside the picture and under no others.
TEST_F(Gl, TheGroundEndsWhereThePictureDoes) {
    Asset asset = twoLevels();
    asset.height = 48;  // the last row of squares lies below the picture
    for (const int i : {0, 1, 3, 4, 8, 10})
        asset.nodes[0].children[i] = solidOf(1);
    for (int i = 12; i < 16; ++i)
        asset.nodes[0].children[i] = solidOf(0);
    ASSERT_NO_THROW(asset::validate(asset));
    for (const double zoom : {0.7, 3.0, 20.0, 150.0})
        for (const glm::dvec2 at : {glm::dvec2(0.3, 0.2), glm::dvec2(63.5, 47.5), glm::dvec2(30, 24)}) {
            const View view = turnedView(50, 40, at, zoom, 0.3, 0.2);
            EXPECT_LE(worst(drawn(asset, view), asset::evaluate(asset, view)), tolerance) << zoom;
            for (const bool mirrored : {false, true}) {
                const Wrap wrap = mirrored ? Wrap::Mirror : Wrap::Repeat;
                EXPECT_LE(worst(drawn(asset, view, {wrap, wrap}), sumOfCopies(asset, view, mirrored, -2, 3)),
                          tolerance)
                    << mirrored << ' ' << zoom;
            }
        }
}

TEST_F(Gl, OneColourIsItselfAtAnySizeUnderAnyWrap) {
    Asset asset = emptyAsset();
    asset.maps[0].root = solidOf(2);
    for (const Wrap wrap : {Wrap::Repeat, Wrap::Mirror, Wrap::Clamp})
        for (double zoom = 0.001; zoom < 5000; zoom *= 3.7) {
            const Raster raster = drawn(asset, turnedView(24, 24, {1, 63}, zoom, 0.7, 0.3), {wrap, wrap});
            for (std::size_t i = 0; i < raster.rgba.size(); ++i)
                ASSERT_NEAR(raster.rgba[i], i % 2 == 1 ? 1 : 0, 1.0 / 255) << int(wrap) << ' ' << zoom;
        }
}

TEST_F(Gl, BeyondABorderThereIsNothingAndBeyondAClampedEdgeItsColour) {
    const Asset asset = halfPlane(20001, 20001);                     // red, then green
    const View view{64, 8, glm::dmat3x2(0.25, 0, 0, 0.25, 24, -4)};  // the picture on columns 24 to 40
    const Raster border = drawn(asset, view), clamped = drawn(asset, view, {Wrap::Clamp, Wrap::Clamp});
    for (int x = 0; x < 64; ++x) {
        const bool isInside = x >= 24 && x < 40;
        EXPECT_NEAR(border.pixel(x, 3)[3], isInside ? 1 : 0, tolerance) << x;
        EXPECT_NEAR(clamped.pixel(x, 3)[3], 1, tolerance) << x;
        if (!isInside) {
            EXPECT_NEAR(clamped.pixel(x, 3)[0], x < 24 ? 1 : 0, tolerance) << x;
        }
    }
    const Raster oneAxis = drawn(asset, view, {Wrap::Clamp, Wrap::Border});
    EXPECT_NEAR(oneAxis.pixel(2, 3)[0], 1, tolerance);
}

/// Boxes that touch the picture's end without meeting it: upright, on whole pixels, on all sides.
TEST_F(Gl, PixelsBesideAPictureShowNothing) {
    const Asset asset = twoLevels();
    test::TextureCanvas canvas(asset);
    for (const bool mirrored : {false, true})
        for (const double zoom : {1.0, 2.0}) {
            const View view = turnedView(160, 160, {32, 32}, zoom, 0, 0, mirrored);
            const Raster raster = canvas.draw(view);
            const int first = 80 - int(32 * zoom), end = 80 + int(32 * zoom);
            const auto isOutside = [&](int i) { return i < first || i >= end; };
            for (int y = 0; y < 160; ++y)
                for (int x = 0; x < 160; ++x)
                    if (isOutside(x) || isOutside(y)) {
                        EXPECT_LE(raster.pixel(x, y)[3], 1e-5) << x << ", " << y;
                    }
        }
}

TEST_F(Gl, MinifiedTexturesAreTheirMean) {
    const Asset asset = disc();
    const float mean = float(discRadius * discRadius * 3.14159265 / (65535.0 * 65535.0));
    const View far = turnedView(4, 4, {32, 32}, 0.002, 0.3);
    EXPECT_NEAR(drawn(asset, far, {Wrap::Repeat, Wrap::Repeat}).pixel(1, 1)[0], mean, tolerance);
    // Half the picture is outside: so is half the colour.
    const View edge{1, 1, glm::dmat3x2(1.0 / 64, 0, 0, 1.0 / 64, -0.5, 0)};
    EXPECT_NEAR(drawn(asset, edge).pixel(0, 0)[0], mean / 2, tolerance);
}

/// Where the prefilter draws alone, the shader takes the taps that asset::samplePrefilter takes.
TEST_F(Gl, ThePrefilterIsSampledAsTheCpuDoes) {
    Asset asset = threeRegions();
    asset.prefilter = asset::buildPrefilter(asset, asset::PyramidSize{32, 32});
    SampledTexture texture(asset);
    test::ShaderCanvas canvas(sampleInclude({asset}), R"(
uniform Vtm sign;
const mat2 footprint = mat2(0.126, 0.063, -0.063, 0.126);  // 4.5 texels a side
vec4 shade(vec2 pixel) { return vtm_sample_grad(sign, 3.0 * pixel / 48.0 - 1.0, footprint[0], footprint[1]); })");
    const glm::mat2 footprint(0.126f, 0.063f, -0.063f, 0.126f);
    ASSERT_EQ(asset::prefilterShare(asset, footprint), 1);
    for (const Wrap wrap : {Wrap::Border, Wrap::Repeat, Wrap::Mirror}) {
        texture.bind(canvas.program(), "sign", 0, {wrap, wrap});
        const Raster raster = canvas.draw(48, 48);
        for (int i = 0; i < 48 * 48; ++i) {
            const glm::vec2 st = 3.0f * (glm::vec2(i % 48, i / 48) + 0.5f) / 48.0f - 1.0f;
            const glm::vec4 color =
                asset::samplePrefilter(asset, st, footprint, asset::Minification::Taps4, wrap);
            for (int c = 0; c < 4; ++c)
                ASSERT_NEAR(raster.pixel(i % 48, i / 48)[c], color[c], tolerance) << int(wrap) << ' ' << i;
        }
    }
}

/// A red picture with a green prefilter shows the prefilter's share: of w x l texels as of a square of (w w
/// l)^(1/3).
TEST_F(Gl, LongFootprintsComeFromThePrefilterAsWiderOnesDo) {
    constexpr float side = 64;
    Asset asset = emptyAsset();
    asset.maps[0].root = solidOf(1);
    asset.prefilter = asset::buildPrefilter(asset, asset::PyramidSize{unsigned(side), unsigned(side)});
    std::ranges::fill(asset.prefilter.texels, asset::Rgba8{0, 255, 0, 255});
    SampledTexture texture(asset);
    for (const float width : {1.25f, 2.0f, 2.9f})
        for (const float wide : {2.95f, 3.2f, 3.5f, 3.8f}) {
            const float length = wide * wide * wide / (width * width);
            if (length < width || length > 16 * width)
                continue;
            test::ShaderCanvas canvas(sampleInclude({asset}), fmt::format(R"(
uniform Vtm sign;
const mat2 footprint = mat2(0.8, 0.6, -0.6, 0.8);
vec4 shade(vec2 pixel) {{
    return vtm_sample_grad(sign, pixel / 8.0, footprint[0] * {:.9f}, footprint[1] * {:.9f});
}})",
                                                                          width / side, length / side));
            texture.bind(canvas.program(), "sign", 0, {Wrap::Repeat, Wrap::Repeat});
            const float share = std::log(wide / asset::fadeFrom) / std::log(asset::fadeTo / asset::fadeFrom);
            EXPECT_NEAR(canvas.draw(8, 8).pixel(3, 4)[1], std::clamp(share, 0.0f, 1.0f), 1.0 / 128)
                << width << " x " << length;
        }
}

TEST_F(Gl, DerivativesCanBeGiven) {
    const Asset asset = threeRegions();
    SampledTexture texture(asset);
    test::ShaderCanvas canvas(sampleInclude({asset}), R"(
uniform Vtm sign;
vec4 shade(vec2 pixel) {  // 32 pixels a side, seen as on 8
    vec2 corner = (floor(pixel / 4.0) + 0.5) / 8.0;
    return vtm_sample_grad(sign, corner, vec2(0.125, 0.0), vec2(0.0, 0.125));
})");
    texture.bind(canvas.program(), "sign", 0);
    const Raster blocks = canvas.draw(32, 32),
                 small = asset::evaluate(asset, {8, 8, glm::dmat3x2(0.125, 0, 0, 0.125, 0, 0)});
    for (int i = 0; i < 32 * 32; ++i)
        for (int c = 0; c < 4; ++c)
            ASSERT_NEAR(blocks.pixel(i % 32, i / 32)[c], small.pixel(i % 32 / 4, i / 128)[c], tolerance) << i;
}

TEST_F(Gl, FootprintsThatAreNoneAreDrawnToo) {
    const Asset asset = threeRegions();
    SampledTexture texture(asset);
    test::ShaderCanvas canvas(sampleInclude({asset}), R"(
uniform Vtm sign;
vec4 shade(vec2 pixel) {
    float huge = 1e30 * pixel.x, zero = 0.0 * pixel.x, none = zero / zero;
    vec2 st = vec2(0.4, 0.2);
    if (pixel.y < 1.0) return vtm_sample_grad(sign, st, vec2(0.0), vec2(0.0));
    if (pixel.y < 2.0) return vtm_sample_grad(sign, st, vec2(0.1, 0.1), vec2(0.2, 0.2));
    if (pixel.y < 3.0) return vtm_sample_grad(sign, st, vec2(huge), vec2(zero));
    if (pixel.y < 4.0) return vtm_sample_grad(sign, st, vec2(huge * huge), vec2(none));
    if (pixel.y < 5.0) return vtm_sample_grad(sign, st, vec2(1e-20), vec2(-1e-20, 1e-20));
    return vtm_sample_grad(sign, vec2(none), vec2(0.1), vec2(0.0));
})");
    for (const Wrap wrap : {Wrap::Border, Wrap::Clamp, Wrap::Repeat, Wrap::Mirror}) {
        texture.bind(canvas.program(), "sign", 0, {wrap, wrap});
        const Raster raster = canvas.draw(4, 6);
        for (const int y : {0, 4})
            EXPECT_NEAR(raster.pixel(1, y)[0], 1, tolerance) << y;  // the point's colour
        for (const float value : raster.rgba)
            EXPECT_TRUE(value >= 0 && value <= 1) << value;
    }
}

TEST_F(Gl, SeveralTexturesShareAProgram) {
    const Asset first = everyPaint(), second = disc(), third = blendAsset(asset::Blend::Multiply);
    SampledTexture a(first), b(second), c(third);
    EXPECT_EQ(a.units(), 3u);
    EXPECT_EQ(b.units(), 2u);
    test::ShaderCanvas canvas(sampleInclude({first, second, third}), R"(
uniform Vtm wall, signs[2];
vec4 shade(vec2 pixel) {
    vec2 st = pixel / 64.0;
    vec4 first = vtm_sample(signs[0], st), second = vtm_sample(signs[1], st - vec2(1.0, 0.0));
    vec4 third = vtm_sample(wall, st - vec2(2.0, 0.0));
    return first + second + third;
})");
    a.bind(canvas.program(), "wall", 0);
    b.bind(canvas.program(), "signs[0]", 3);
    c.bind(canvas.program(), "signs[1]", 5);
    const Raster all = canvas.draw(192, 64);
    const View view{64, 64};
    for (int i = 0; i < 3; ++i) {
        const Asset& asset = i == 0 ? second : i == 1 ? third : first;
        const Raster one = drawn(asset, view);
        for (int y = 0; y < 64; ++y)
            for (int x = 1; x < 63; ++x)
                for (int channel = 0; channel < 4; ++channel)
                    ASSERT_NEAR(all.pixel(x + 64 * i, y)[channel], one.pixel(x, y)[channel], tolerance) << i;
    }
}

// ---- Perspective --------------------------------------------------------------------------------------

/// A floor whose horizon is twelve pixels above the raster, in homogeneous (s, t).
constexpr const char* floorText = R"(
vec3 onFloor(vec2 pixel) { return vec3(0.004 * (pixel.x - 32.0), 0.2, 0.05 * (pixel.y + 12.0)); })";

/// The mean of n × n points of vtm_sample_grad's, each over its share of the pixel, is exact in the limit.
TEST_F(Gl, PerspectiveIsThatOfTheSurface) {
    const Asset asset = disc();
    SampledTexture texture(asset);
    const std::string include = sampleInclude({asset}) + "uniform Vtm sign;\n";
    test::ShaderCanvas surface(include, "in vec2 st;\nvec4 shade(vec2 p) { return vtm_sample(sign, st); }",
                               std::string("#version 300 es\nout vec2 st;") + floorText + R"(
void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    vec3 stq = onFloor(64.0 * corner);
    st = stq.xy / stq.z;
    gl_Position = vec4(2.0 * corner - 1.0, 0.0, 1.0) / stq.z;
})"),
        plane(include + floorText, "vec4 shade(vec2 p) { return vtm_sample_proj(sign, onFloor(p)); }"),
        truth(include + floorText, R"(
vec4 shade(vec2 p) {
    const float n = 8.0;
    vec4 sum = vec4(0.0);
    for (float y = 0.5 - 0.5 * n; y < 0.5 * n; ++y)
        for (float x = 0.5 - 0.5 * n; x < 0.5 * n; ++x) {
            vec3 at = onFloor(p + vec2(x, y) / n), right = onFloor(p + vec2(x + 1.0, y) / n), down = onFloor(p + vec2(x, y + 1.0) / n);
            vec2 st = at.xy / at.z;
            vec2 dx = ((right - at).xy - st * (right - at).z) / at.z, dy = ((down - at).xy - st * (down - at).z) / at.z;
            sum += vtm_sample_grad(sign, st, dx, dy);
        }
    return sum / (n * n);
})");
    for (test::ShaderCanvas* canvas : {&surface, &plane, &truth})
        texture.bind(canvas->program(), "sign", 0, {Wrap::Repeat, Wrap::Repeat});
    const Raster onSurface = surface.draw(64, 64), onPlane = plane.draw(64, 64),
                 expected = truth.draw(64, 64);
    constexpr float sameMaths = 1e-3f, aStripsError = 1.5f / 256;
    for (std::size_t i = 0; i < expected.rgba.size(); ++i) {
        ASSERT_NEAR(onSurface.rgba[i], onPlane.rgba[i], sameMaths) << i / 4 % 64 << ' ' << i / 256;
        ASSERT_NEAR(onPlane.rgba[i], expected.rgba[i], aStripsError) << i / 4 % 64 << ' ' << i / 256;
    }
}

// ---- Contract -----------------------------------------------------------------------------------------

TEST_F(Gl, MakingAndBindingLeavesTheUsersState) {
    const Asset asset = everyPaint();
    test::ShaderCanvas canvas(sampleInclude({asset}),
                              "uniform Vtm sign;\nvec4 shade(vec2 p) { return vtm_sample(sign, p); }"),
        other("precision highp float;", "vec4 shade(vec2 p) { return vec4(p, 0.0, 1.0); }");
    const TextureHandle mine = makeTexture(GL_RGBA8, 4, 4);
    const BufferHandle buffer = makeBuffer();
    glUseProgram(other.program());
    glActiveTexture(GL_TEXTURE7);
    glBindTexture(GL_TEXTURE_2D, mine.get());
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, buffer.get());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 2);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 17);
    glPixelStorei(GL_UNPACK_SKIP_ROWS, 3);
    glPixelStorei(GL_UNPACK_SKIP_PIXELS, 5);
    const auto state = [] {
        std::vector<int> values;
        for (const GLenum name : {GL_CURRENT_PROGRAM, GL_ACTIVE_TEXTURE, GL_TEXTURE_BINDING_2D,
                                  GL_SAMPLER_BINDING, GL_PIXEL_UNPACK_BUFFER_BINDING, GL_UNPACK_ALIGNMENT,
                                  GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS,
                                  GL_VERTEX_ARRAY_BINDING, GL_FRAMEBUFFER_BINDING, GL_ARRAY_BUFFER_BINDING})
            values.push_back(limit(name));
        return values;
    };
    const std::vector<int> before = state();
    SampledTexture texture(asset);
    EXPECT_EQ(state(), before);
    texture.bind(canvas.program(), "sign", 1, {Wrap::Repeat, Wrap::Mirror});
    EXPECT_EQ(state(), before);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    for (const GLenum name : {GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS})
        glPixelStorei(name, 0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

TEST_F(Gl, WhatCannotBeSampledIsAnError) {
    EXPECT_THROW(SampledTexture{layers()}, GlError);  // compat mode
    const Asset asset = disc();
    SampledTexture texture(asset);
    test::ShaderCanvas canvas(sampleInclude({asset}),
                              "uniform Vtm sign;\nvec4 shade(vec2 p) { return vtm_sample(sign, p); }");
    const auto complaint = [&](const char* name, unsigned unit) -> std::string {
        try {
            texture.bind(canvas.program(), name, unit);
        } catch (const GlError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(complaint("sign", 0), "");
    EXPECT_NE(complaint("sing", 0).find("no 'uniform Vtm sing'"), std::string::npos);
    const unsigned units = unsigned(limit(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS));
    EXPECT_EQ(complaint("sign", units - 2), "");
    EXPECT_NE(complaint("sign", units - 1).find("the driver has"), std::string::npos);
    EXPECT_NE(complaint("sign", ~0u), "");
    glEnable(0x1234);
    EXPECT_NE(complaint("sign", 0).find("before"), std::string::npos);
}

TEST_F(Gl, AnIncludeForOtherAssetsIsSeenAtOnce) {
    const Asset plain = disc(), gradients = blendAsset(asset::Blend::Normal);
    SampledTexture texture(gradients);
    test::ShaderCanvas canvas(sampleInclude({plain}),
                              "uniform Vtm sign;\nvec4 shade(vec2 p) { return vtm_sample(sign, p / 8.0); }");
    texture.bind(canvas.program(), "sign", 0);
    const Raster raster = canvas.draw(8, 8);
    for (std::size_t i = 0; i < raster.rgba.size(); ++i)
        ASSERT_EQ(raster.rgba[i], i % 4 == 1 ? 0 : 1);  // magenta
}

Asset discGround() {
    Asset ground = emptyAsset();
    ground.width = ground.height = 64;
    ground.maps = {{0, 0, 64, asset::Entry::make(asset::Entry::Kind::Solid, 1), 0}};
    ground.paints = {{}, {0, 0, 0x3F000000u, 0x3F800000u}};
    return ground;
}

/// An animation: a thousand discs move.
Asset discsAt(double time) {
    Asset ground = discGround();
    const asset::Placement one = asset::addPicture(ground, disc());
    std::vector<asset::Placement> placements;
    for (int i = 0; i < 1000; ++i) {
        asset::Placement moved = one;
        moved.paints[0] = 1;
        const double angle = time + i, scale = 0.8 / 64;
        const glm::dmat2 linear(scale * std::cos(angle), scale * std::sin(angle), -scale * std::sin(angle),
                                scale * std::cos(angle));
        const glm::dvec2 middle(2.0 * (i % 31) + 2 + 0.4 * std::cos(time),
                                1.9 * (i / 31) + 1.5 + 0.3 * std::sin(time));
        moved.toPicture = glm::dmat3x2(linear * one.toPicture[0], linear * one.toPicture[1],
                                       linear * (one.toPicture[2] - glm::dvec2(32)) + middle);
        placements.push_back(moved);
    }
    return asset::withPlacements(ground, placements);
}

/// Only the records of what moves are sent.
TEST_F(Gl, ChangedPlacementsAreShownAtOnce) {
    SampledTexture texture(discsAt(0));
    test::ShaderCanvas canvas(sampleInclude({discsAt(0)}), R"(
uniform Vtm picture;
uniform mat3 toPicture;
vec4 shade(vec2 pixel) { return vtm_sample_proj(picture, toPicture * vec3(pixel, 1.0) / gl_FragCoord.w); })");
    const std::size_t first = texture.update(discsAt(0.1), false);
    for (const double time : {0.2, 0.5, 1.4}) {
        const Asset now = discsAt(time);
        const std::size_t sent = texture.update(now, false);
        EXPECT_LT(sent, first);
        EXPECT_GE(sent, 1000u * 16);
        // The records of instances and the grid that finds them: two to three cells name each.
        EXPECT_LE(sent, 4 * now.instances.size() * 16);
        const View view = turnedView(60, 60, {32 + time, 30}, 12, 0.3);
        const glm::dmat3 toPixels(glm::dvec3(view.toPixels[0], 0), glm::dvec3(view.toPixels[1], 0),
                                  glm::dvec3(view.toPixels[2], 1));
        canvas.set("toPicture", glm::dmat3(1.0 / 64, 0, 0, 0, 1.0 / 64, 0, 0, 0, 1) * glm::inverse(toPixels));
        texture.bind(canvas.program(), "picture", 0);
        EXPECT_LE(worst(canvas.draw(60, 60), asset::evaluate(now, view)), tolerance) << time;
    }
    EXPECT_EQ(texture.update(discsAt(1.4), false), 0u);
    EXPECT_THROW(texture.update(everyPaint(), false), std::invalid_argument);
    Asset ground = discGround();
    const asset::Placement one = asset::addPicture(ground, disc());
    EXPECT_GT(texture.update(asset::withPlacements(ground, std::vector(1, one)), true), 0u);
}

/// One that runs out of turns may stop inside a placed map.
TEST_F(Gl, ASampleThatIsGivenUpLeavesTheNextAsItIs) {
    Asset discs = discsAt(0);
    discs.prefilter = asset::buildPrefilter(discs, asset::PyramidSize{1, 1});
    SampledTexture texture(discs);
    test::ShaderCanvas canvas("#define VTM_SAMPLES 16\n" + sampleInclude({discs}), R"(
uniform Vtm picture;
vec4 shade(vec2 pixel) {
    vec4 wide = vtm_sample_grad(picture, vec2(0.5), vec2(0.01 * pixel.x, 0.0), vec2(0.0, 0.01 * pixel.x));
    return vtm_sample_grad(picture, vec2(0.001), vec2(1e-4, 0.0), vec2(0.0, 1e-4)) + 1e-9 * wide;
})");
    texture.bind(canvas.program(), "picture", 0);
    const Raster raster = canvas.draw(80, 1);
    for (int x = 0; x < 80; ++x)
        EXPECT_NEAR(raster.pixel(x, 0)[3], 1, 1e-6) << x;
}

}  // namespace
}  // namespace vtm::gl
