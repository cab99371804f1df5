// Pyramids of means that are drawn, against those that the CPU makes.
#include "backend_gl/texture/prefilter_texture.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string_view>
#include <utility>
#include <vector>

#include <vtm/compiler/compile.hpp>
#include <vtm/compiler/session.hpp>
#include <vtm/svg/load.hpp>
#include "asset/testing.hpp"
#include "backend_gl/core/state_guard.hpp"
#include "backend_gl/testing.hpp"
#include "backend_gl/tests/gl_fixture.hpp"
#include "backend_gl/texture/sample_include.hpp"
#include "backend_gl/upload/asset_texels.hpp"

namespace vtm::gl {
namespace {

using asset::Asset;
using asset::PyramidSize;
using asset::Wrap;
using namespace asset::test;

/// All levels, the finest first.
std::vector<asset::Rgba8> texelsOf(const PrefilterTexture& pyramid) {
    const FramebufferHandle framebuffer = makeFramebuffer();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.get());
    const PyramidSize& size = pyramid.size;
    std::vector<asset::Rgba8> texels(size.texelsBefore(size.levels()));
    for (unsigned l = 0; l < size.levels(); ++l) {
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, pyramid.texture.get(),
                               GLint(l));
        const PyramidSize level = size.level(l);
        glReadPixels(0, 0, GLsizei(level.width), GLsizei(level.height), GL_RGBA, GL_UNSIGNED_BYTE,
                     &texels[size.texelsBefore(l)]);
    }
    checkErrors("reading a pyramid");
    return texels;
}

/// Of 255.
int largestDifference(const std::vector<asset::Rgba8>& a, const std::vector<asset::Rgba8>& b) {
    int largest = a.size() == b.size() ? 0 : 256;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        for (std::size_t c = 0; c < 4; ++c)
            largest = std::max(largest, std::abs(int(a[i][c]) - int(b[i][c])));
    return largest;
}

struct Made {
    PrefilterTexture pyramid;
    bool isDrawn;
};

Made madeBy(Pixels pixels, const Asset& asset, const asset::PrefilterOptions& options = {}) {
    const SampledKinds kinds{innerMapsOf(asset), false};
    VtmUniform uniform;
    uniform.width = asset.width;
    uniform.height = asset.height;
    uniform.map = asset.maps[asset.commands[0].map];
    uniform.flags = samplingFlags(featuresOf(asset), kinds);
    const TextureHandle records = texelTexture(recordTexels(asset, {}, uniform.parts));
    const StateContract contract;
    const StateGuard guard(contract, true);
    PrefilterMaker maker(featuresOf(asset), kinds);
    PrefilterTexture pyramid = maker.make(asset, options, pixels, uniform, records.get());
    return {std::move(pyramid), maker.hasDrawn()};
}

constexpr const char* gradientsAndMasks = R"svg(
<svg xmlns="http://www.w3.org/2000/svg" width="90" height="40">
<linearGradient id="l"><stop stop-color="#e02020"/><stop offset=".5" stop-color="#20a0e0"/>
<stop offset="1" stop-color="#ffe000"/></linearGradient>
<radialGradient id="r"><stop stop-color="white"/><stop offset="1" stop-color="#103060"/></radialGradient>
<mask id="m"><rect width="90" height="40" fill="url(#l)"/></mask>
<rect width="90" height="40" fill="url(#l)"/>
<circle cx="30" cy="20" r="18" fill="url(#r)" opacity=".8"/>
<g style="mix-blend-mode:multiply"><path d="M40 2 88 8 60 38z" fill="url(#r)"/></g>
<path d="M5 5 85 9 50 36z" mask="url(#m)" fill="#008000"/>
</svg>)svg";

/// So many triangles, each of its own colour, at random.
scene::Scene triangles(unsigned seed, int count, double size) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(0, 64), away(-size, size);
    std::uniform_real_distribution<float> channel(0, 1);
    scene::Scene scene;
    scene.width = scene.height = 64;
    for (int i = 0; i < count; ++i) {
        const scene::Point p(place(random), place(random));
        const auto corner = [&] { return p + scene::Point(away(random), away(random)); };
        scene::Item item;
        item.path = std::make_shared<scene::Path>(scene::polygon({corner(), corner(), corner()}));
        item.paint = scene::Color{channel(random), channel(random), channel(random), 1};
        scene.root.children.push_back({std::move(item)});
    }
    return scene;
}

Asset compiled(const scene::Scene& scene) { return compiler::compile(scene).asset; }

std::vector<Asset> assets() {
    const std::string_view svg = gradientsAndMasks;
    Asset hue = blendAsset(asset::Blend::Hue);
    hue.images.clear();  // which it does without
    return {halfPlane(),
            wedge(),
            threeRegions(),
            disc(),
            twoLevels(),
            placedMaps(),
            hue,
            compiled(svg::load({reinterpret_cast<const std::uint8_t*>(svg.data()), svg.size()}).scene),
            compiled(triangles(1, 400, 5))};
}

class DrawnPrefilters : public Gl {};

TEST_F(DrawnPrefilters, AreThoseOfTheCpu) {
    for (std::size_t i = 0; const Asset& asset : assets()) {
        SCOPED_TRACE(i++);
        const Made drawn = madeBy(Pixels::Shaders, asset), computed = madeBy(Pixels::Scanned, asset);
        EXPECT_TRUE(drawn.isDrawn);
        EXPECT_FALSE(computed.isDrawn);
        const asset::Prefilter expected = asset::buildPrefilter(asset);
        EXPECT_EQ(drawn.pyramid.size.width, expected.size.width);
        EXPECT_EQ(drawn.pyramid.size.height, expected.size.height);
        EXPECT_EQ(largestDifference(texelsOf(computed.pyramid), expected.texels), 0);
        EXPECT_LE(largestDifference(texelsOf(drawn.pyramid), expected.texels), 1);
    }
}

TEST_F(DrawnPrefilters, HaveAnySize) {
    const Asset asset = compiled(triangles(2, 12, 5));
    for (const unsigned side : {3u, 12u, 24u}) {
        asset::PrefilterOptions options;
        options.largestSide = side;
        const Made drawn = madeBy(Pixels::Shaders, asset, options);
        EXPECT_TRUE(drawn.isDrawn);
        EXPECT_EQ(drawn.pyramid.size.width, side);
        const asset::Prefilter expected = asset::buildPrefilter(asset, drawn.pyramid.size);
        EXPECT_LE(largestDifference(texelsOf(drawn.pyramid), expected.texels), 1) << side;
    }
}

TEST_F(DrawnPrefilters, WhatTakesAFragmentTooLongIsComputed) {
    const Asset asset = compiled(triangles(3, 3000, 5));
    asset::PrefilterOptions options;
    options.largestSide = 1;
    const Made made = madeBy(Pixels::Shaders, asset, options);
    EXPECT_FALSE(made.isDrawn);
    EXPECT_EQ(
        largestDifference(texelsOf(made.pyramid), asset::buildPrefilter(asset, PyramidSize{1, 1}).texels), 0);
    // Images are not at hand, and the CPU has no materials.
    EXPECT_FALSE(madeBy(Pixels::Shaders, everyPaint()).isDrawn);
}

// ---- Updates ------------------------------------------------------------------------------------------

/// Both ways side by side, so small that the pyramids are all that is seen.
class BothWays {
public:
    explicit BothWays(const Asset& asset)
        : drawn_(asset), computed_(asset), canvas_(sampleInclude({asset}), R"(
uniform Vtm drawn, computed;
vec4 shade(vec2 pixel) {
    vec2 st = pixel / vec2(8.0, 16.0), d = vec2(0.125);
    return pixel.y < 16.0 ? vtm_sample_grad(drawn, st, vec2(d.x, 0.0), vec2(0.0, d.y))
                          : vtm_sample_grad(computed, st, vec2(d.x, 0.0), vec2(0.0, d.y));
})") {}

    /// Shows the asset; returns what the two differ by.
    double update(const Asset& asset) {
        drawn_.update(asset, true, Pixels::Shaders);
        computed_.update(asset, true, Pixels::Scanned);
        drawn_.bind(canvas_.program(), "drawn", 0, {Wrap::Repeat, Wrap::Repeat});
        computed_.bind(canvas_.program(), "computed", 2, {Wrap::Repeat, Wrap::Repeat});
        shown = canvas_.draw(8, 32);
        double largest = 0;
        for (std::size_t i = 0; i < shown.rgba.size() / 2; ++i)
            largest =
                std::max(largest, double(std::abs(shown.rgba[i] - shown.rgba[shown.rgba.size() / 2 + i])));
        return largest;
    }

    image::Raster shown;

private:
    SampledTexture drawn_, computed_;
    test::ShaderCanvas canvas_;
};

constexpr double apart = 1.0 / 255 + 1e-5;

TEST_F(DrawnPrefilters, FollowTheEditsOfASession) {
    scene::Scene scene = triangles(4, 150, 6);
    compiler::Session session(scene);
    BothWays textures(session.result().asset);
    std::vector<float> before;
    for (int step = 0; step < 6; ++step) {
        auto& item = std::get<scene::Item>(scene.root.children[std::size_t(step) * 20 + 5].value);
        item.transform[2] += scene::Point(9 - step, 4 * step);
        item.paint = scene::Color{0, 1, 0, 1};
        if (step % 2 == 1)
            scene.root.children.erase(scene.root.children.begin() + step);
        session.update(scene);
        EXPECT_LE(textures.update(session.result().asset), apart) << step;
        EXPECT_NE(textures.shown.rgba, before) << step;
        before = textures.shown.rgba;
    }
}

TEST_F(DrawnPrefilters, FollowInAContextThatShares) {
    ContextOptions options;
    options.share = context.get();
    const Asset first = compiled(triangles(5, 60, 6)), next = compiled(triangles(6, 60, 6));
    SampledTexture texture(first);
    {
        const Context second(options);
        texture.update(next, true, Pixels::Shaders);
        context->makeCurrent();
        texture.update(first, true, Pixels::Shaders);
        second.makeCurrent();
        texture.update(next, true, Pixels::Shaders);
        glFinish();
    }
    context->makeCurrent();
    BothWays expected(next);
    expected.update(next);
    test::ShaderCanvas canvas(sampleInclude({next}), R"(
uniform Vtm picture;
vec4 shade(vec2 pixel) {
    return vtm_sample_grad(picture, pixel / vec2(8.0, 16.0), vec2(0.125, 0.0), vec2(0.0, 0.125));
})");
    texture.bind(canvas.program(), "picture", 0, {Wrap::Repeat, Wrap::Repeat});
    const image::Raster shown = canvas.draw(8, 16);
    EXPECT_TRUE(std::equal(shown.rgba.begin(), shown.rgba.end(), expected.shown.rgba.begin()));
}

}  // namespace
}  // namespace vtm::gl
