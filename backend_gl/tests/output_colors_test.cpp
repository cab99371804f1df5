// The numbers that users' framebuffers get: straight and linear ones, dithering, light added as light.

#include <stdexcept>

#include "backend_gl/tests/output_support.hpp"

namespace vtm::gl {
namespace {

TEST_F(Gl, StraightAndLinearColours) {
    for (const Asset& asset : assets()) {
        const Texture texture = renderer->upload(asset);
        const image::Raster picture = renderer->render(texture, turned());
        Output output;
        output.alpha = Output::Alpha::Straight;
        const UserFramebuffer straightTarget(GL_RGBA32F, side, side);
        renderer->draw(texture, turned(), output);
        const image::Raster drawn = straightTarget.floats();
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const Color c = pixelOf(picture, x, y), s = straight(c), got = pixelOf(drawn, x, y);
                EXPECT_NEAR(got[3], c[3], 1e-6);
                for (std::size_t i = 0; i < 3; ++i)
                    EXPECT_NEAR(got[i] * c[3], s[i] * c[3], conversion);
            }
        output.alpha = Output::Alpha::Premultiplied;
        output.encoding = Output::Encoding::Linear;
        const UserFramebuffer linear(GL_RGBA32F, side, side);
        renderer->draw(texture, turned(), output);
        EXPECT_LE(worst(linear.floats(), picture, toLinear), conversion);
    }
}

/// A ramp of a tenth of the range, so that 8 bits show steps.
Asset shallowRamp() {
    std::vector<asset::Texel> data;
    const auto stop = [](float offset, std::uint16_t v) {
        return asset::GradientStop{offset, {v, v, v, 65535}, 0};
    };
    asset::Gradient gradient;
    gradient.matrix = {float(1 / mapSide), 0, 0, 0, 0, 0};
    gradient.stopCount = 2;
    const std::uint32_t at = addGradient(data, gradient, {stop(0, 20000), stop(1, 26000)});
    return programAsset({{asset::Op::Linear, {}, 1, at}}, data);
}

TEST_F(Gl, DitheringKeepsTheMeanAndExactColours) {
    const View view{64, 64, {1, 0, 0, 1, 0, 0}};
    for (const GLenum format : {GL_RGBA8, GL_SRGB8_ALPHA8}) {
        const Texture ramp = renderer->upload(shallowRamp());
        const image::Raster picture = renderer->render(ramp, view);
        const UserFramebuffer target(format, 64, 64);
        Output output;
        output.dither = true;
        renderer->draw(ramp, view, output);
        const std::vector<std::uint8_t> drawn = target.bytes();
        renderer->draw(ramp, view, output);
        EXPECT_EQ(target.bytes(), drawn);
        // The mean of eight rows of a column is the column's value to a 64th of the pattern's range: the
        // offsets of eight rows of one column are spread evenly but for their order.
        double worstMean = 0, worstPlain = 0;
        for (int x = 0; x < 64; x += 8) {
            double mean = 0, exact = 0, plain = 0;
            for (int y = 0; y < 8; ++y)
                for (int i = x; i < x + 8; ++i) {
                    mean += drawn[std::size_t((y * 64 + i) * 4)] / 64.0;
                    exact += 255 * picture.pixel(i, y)[0] / 64.0;
                    plain += std::round(255 * picture.pixel(i, y)[0]) / 64.0;
                }
            worstMean = std::max(worstMean, std::abs(mean - exact));
            worstPlain = std::max(worstPlain, std::abs(plain - exact));
        }
        EXPECT_LT(worstMean, 0.12);
        EXPECT_GT(worstPlain, 2 * worstMean);
        // 64/255 is a number that bytes hold.
        Asset exact = emptyAsset();
        exact.paints[1] = solid({64 / 255.0f, 128 / 255.0f, 1, 1});
        exact.maps[0].root = asset::Entry::make(asset::Entry::Kind::Solid, 1);
        renderer->draw(renderer->upload(exact), view, output);
        const std::vector<std::uint8_t> same = target.bytes();
        for (std::size_t i = 0; i < same.size(); i += 4)
            ASSERT_TRUE(same[i] == 64 && same[i + 1] == 128 && same[i + 2] == 255 && same[i + 3] == 255);
    }
}

TEST_F(Gl, LinearLightAddsLight) {
    // Half black, half white: the mean of the light is 1/2 at a pixel that the border halves.
    Asset asset = halfPlane(32767, 32767);
    asset.paints[1] = solid({0, 0, 0, 1});
    asset.paints[2] = solid({1, 1, 1, 1});
    const View view{9, 9, {9 / mapSide, 0, 0, 9 / mapSide, 0, 0}};
    const Texture texture = renderer->upload(asset);
    GLint samples = 0;
    glGetInternalformativ(GL_RENDERBUFFER, GL_RGBA16F, GL_SAMPLES, 1, &samples);
    Output output;
    output.linearLight = true;
    const double share = pixelOf(renderer->render(texture, view), 4, 4)[0];
    EXPECT_NEAR(share, 0.5, 1e-3);
    const UserFramebuffer target(GL_RGBA32F, 9, 9);
    renderer->draw(texture, view, output);
    EXPECT_NEAR(pixelOf(target.floats(), 4, 4)[0], encoded(share), conversion);
    EXPECT_NEAR(pixelOf(target.floats(), 2, 4)[0], 0, conversion);
    EXPECT_NEAR(pixelOf(target.floats(), 7, 4)[0], 1, conversion);
    output.encoding = Output::Encoding::Linear;
    renderer->draw(texture, view, output);
    EXPECT_NEAR(pixelOf(target.floats(), 4, 4)[0], share, conversion);
    if (samples >= 2) {
        const UserFramebuffer many(GL_RGBA16F, 9, 9, {}, samples);
        output.encoding = Output::Encoding::Srgb;
        renderer->draw(texture, view, output);
        const UserFramebuffer resolved(GL_RGBA16F, 9, 9);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, many.framebuffer.get());
        glBlitFramebuffer(0, 0, 9, 9, 0, 0, 9, 9, GL_COLOR_BUFFER_BIT, GL_NEAREST);
        EXPECT_NEAR(pixelOf(resolved.floats(), 4, 4)[0], encoded(share), 0x1p-10);
    }
    target.bind();
    EXPECT_THROW(renderer->draw(renderer->upload(layers()), view, output), std::invalid_argument);
}

/// Programs as well as solids, in every numbers a framebuffer may want.
TEST_F(Gl, LinearLightOfPrograms) {
    const Asset asset = blendAsset(asset::Blend::Normal);
    const Texture texture = renderer->upload(asset);
    // Magnified, so that no pixel is rough: those would be averaged in encoded numbers (docs/coverage.md).
    const View view = turnedView(side, side, {32, 32}, 6, 0.4);
    const image::Raster picture = renderer->render(texture, view);
    Output output;
    output.linearLight = true;
    const UserFramebuffer target(GL_RGBA32F, side, side);
    renderer->draw(texture, view, output);
    const image::Raster drawn = target.floats();
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const bool inside = x > 0 && y > 0 && x + 1 < side && y + 1 < side;
            bool uniform = inside;  // pixels of one region, whose sum has one term
            for (int dy = -1; uniform && dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx)
                    uniform &= picture.pixel(x + dx, y + dy)[3] > 0;
            if (!uniform)
                continue;
            for (int c = 0; c < 4; ++c)
                ASSERT_NEAR(drawn.pixel(x, y)[c], picture.pixel(x, y)[c], 1e-4);
        }
}

}  // namespace
}  // namespace vtm::gl
