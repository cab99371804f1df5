// Drawing into users' framebuffers: every promise of output.hpp, against render().

#include <array>
#include <random>
#include <stdexcept>

#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include <gtest/gtest.h>

#include "backend_gl/output/destination.hpp"
#include "backend_gl/tests/output_support.hpp"

namespace vtm::gl {

namespace {

TEST(Boxes, BecomeDisjointAndKeepTheirPixels) {
    std::mt19937 random(8);
    for (int round = 0; round < 50; ++round) {
        std::vector<PixelBox> boxes;
        for (int i = 0; i < 9; ++i) {
            const glm::ivec2 corner(random() % 20, random() % 20);
            boxes.push_back({corner, corner + glm::ivec2(random() % 12, random() % 12)});
        }
        std::array<int, 32 * 32> wanted{}, got{};
        const auto mark = [](const PixelBox& box, std::array<int, 32 * 32>& in, bool count) {
            for (int y = box.min.y; y < box.max.y; ++y)
                for (int x = box.min.x; x < box.max.x; ++x) {
                    int& cell = in.at(std::size_t(y * 32 + x));
                    cell = count ? cell + 1 : 1;
                }
        };
        for (const PixelBox& box : boxes)
            mark(box, wanted, false);
        for (const PixelBox& box : disjoint(boxes))
            mark(box, got, true);
        EXPECT_EQ(got, wanted);
    }
}

TEST_F(Gl, EveryFormatTakesThePicture) {
    for (const Asset& asset : assets()) {
        const Texture texture = renderer->upload(asset);
        const image::Raster picture = renderer->render(texture, turned());
        const UserFramebuffer bytes(GL_RGBA8, side, side);
        renderer->draw(texture, turned(), {});
        EXPECT_LE(worst(rasterOf(bytes), picture, identity), halfByte);
        const UserFramebuffer tens(GL_RGB10_A2, side, side);
        renderer->draw(texture, turned(), {});
        EXPECT_LE(worst(tens.tens(), picture,
                        [](const Color& c) {
                            return Color{c[0], c[1], c[2], std::round(c[3] * 3) / 3};
                        }),
                  1.0 / 1023);  // Mesa's software driver rounds these down
        const UserFramebuffer halves(GL_RGBA16F, side, side);
        renderer->draw(texture, turned(), {});
        EXPECT_LE(worst(halves.floats(), picture, identity), 0x1p-11);
        const UserFramebuffer floats(GL_RGBA32F, side, side);
        renderer->draw(texture, turned(), {});
        EXPECT_LE(worst(floats.floats(), picture, identity), 1e-6);
        const UserFramebuffer srgb(GL_SRGB8_ALPHA8, side, side);
        renderer->draw(texture, turned(), {});
        EXPECT_LE(worst(rasterOf(srgb), picture,
                        [](const Color& c) {
                            const Color linear = toLinear(c);
                            return Color{encoded(linear[0]), encoded(linear[1]), encoded(linear[2]), c[3]};
                        }),
                  halfByte + 0.2 * byteStep);  // drivers may encode by table
    }
}

/// Scanned pixels stand where the shaders' would, and where they cannot serve the shaders do.
TEST_F(Gl, ScannedPicturesAreTheShaders) {
    RendererOptions options;
    options.pixels = Pixels::Scanned;
    Renderer scanning(options);
    constexpr double twins = 2 * byteStep;  // curves: the shaders' range in the box, docs/coverage.md
    for (const Asset& asset : assets()) {
        const Texture texture = scanning.upload(asset), twin = renderer->upload(asset);
        const auto drawn = [](const UserFramebuffer& target, GLenum format) {
            return format == GL_RGBA8 ? rasterOf(target) : target.floats();
        };
        for (const GLenum format : {GL_RGBA8, GL_RGBA16F}) {
            for (const auto firstRow : {Output::FirstRow::Bottom, Output::FirstRow::Top})
                for (const auto write : {Output::Write::Replace, Output::Write::Over}) {
                    Output output;
                    output.firstRow = firstRow;
                    output.write = write;
                    output.x = 3;
                    output.y = -5;
                    output.damage = {{{2, 3, 30, 20}, {20, 20, 28, 28}}};
                    const UserFramebuffer a(format, 64, 64, {0.5f, 0, 0.25f, 1});
                    scanning.draw(texture, turned(), output);
                    const image::Raster scanned = drawn(a, format);
                    const UserFramebuffer b(format, 64, 64, {0.5f, 0, 0.25f, 1});
                    renderer->draw(twin, turned(), output);
                    EXPECT_LE(worst(scanned, drawn(b, format), identity), twins) << format;
                }
        }
        scanning.draw(texture, turned());
    }
}

TEST_F(Gl, RowsOffsetsAndFramebuffersByName) {
    for (const Asset& asset : assets()) {
        const Texture texture = renderer->upload(asset);
        const image::Raster picture = renderer->render(texture, turned());
        for (const auto firstRow : {Output::FirstRow::Bottom, Output::FirstRow::Top})
            for (const auto& [x0, y0] : {std::pair{5, 9}, {-7, -20}, {40, -3}, {1000, 1000}}) {
                const UserFramebuffer target(GL_RGBA8, 64, 64, {1, 1, 1, 1}), other(GL_RGBA8, 64, 64);
                Output output;
                output.framebuffer = target.framebuffer.get();
                output.x = x0;
                output.y = y0;
                output.firstRow = firstRow;
                renderer->draw(texture, turned(), output);
                const image::Raster drawn = rasterOf(target);
                for (int y = 0; y < 64; ++y)
                    for (int x = 0; x < 64; ++x) {
                        const int px = x - x0;
                        const int py = firstRow == Output::FirstRow::Bottom ? y - y0 : side - 1 - (y - y0);
                        const bool inside = px >= 0 && py >= 0 && px < side && py < side;
                        const Color expected = inside ? pixelOf(picture, px, py) : Color{1, 1, 1, 1};
                        const Color got = pixelOf(drawn, x, y);
                        for (std::size_t c = 0; c < 4; ++c)
                            ASSERT_NEAR(got[c], expected[c], 2 * halfByte) << x << ' ' << y;
                    }
                EXPECT_EQ(other.bytes(), std::vector<std::uint8_t>(64 * 64 * 4));
            }
    }
}

TEST_F(Gl, OverBlends) {
    for (const Asset& asset : assets()) {
        const Texture texture = renderer->upload(asset);
        const image::Raster picture = renderer->render(texture, turned());
        const UserFramebuffer target(GL_RGBA16F, side, side, {0.25f, 0.5f, 0, 0.75f});
        Output output;
        output.write = Output::Write::Over;
        renderer->draw(texture, turned(), output);
        EXPECT_LE(worst(target.floats(), picture,
                        [](const Color& c) {
                            const Color ground{0.25, 0.5, 0, 0.75};
                            Color sum = c;
                            for (std::size_t i = 0; i < 4; ++i)
                                sum[i] += (1 - c[3]) * ground[i];
                            return sum;
                        }),
                  0x1p-10);
    }
}

/// What blending relies on: no pixel between squares is left out, none is drawn by two of them.
TEST_F(Gl, EveryPixelIsDrawnOnce) {
    std::mt19937 random(29);
    std::uniform_real_distribution<double> unit(0, 1);
    Output output;
    output.write = Output::Write::Over;
    const Asset shapes[] = {disc(), wedge(), threeRegions()};
    for (int i = 0; i < 60; ++i) {
        // All of one alpha, squares of one colour and others.
        Asset asset = shapes[i % 3];
        for (std::size_t p = 0; p < asset.paints.size(); ++p)
            asset.paints[p] = solid({0.5f * float(p % 2), 0.25f * float(p % 3), 0, 0.5f});
        asset.paints[0] = asset::Paint{};
        for (asset::Leaf& leaf : asset.leaves)
            for (std::uint16_t& corner : leaf.corners)
                corner = corner == 0 ? 4 : corner;
        for (asset::Piece& piece : asset.pieces) {
            piece.left = piece.left == 0 ? 4 : piece.left;
            piece.right = piece.right == 0 ? 4 : piece.right;
        }
        const double zoom = std::exp2(3 + 5 * unit(random)), angle = i % 4 == 0 ? 0 : 7 * unit(random);
        const View view = turnedView(256, 200, {20 + 24 * unit(random), 20 + 24 * unit(random)}, zoom, angle,
                                     unit(random) - 0.5, i % 2 == 1);
        const Texture texture = renderer->upload(asset);
        const UserFramebuffer target(GL_RGBA32F, 256, 200);
        renderer->draw(texture, view, output);
        const image::Raster drawn = target.floats();
        const glm::dmat2 inverse = glm::inverse(glm::dmat2(view.toPixels[0], view.toPixels[1]));
        for (int y = 0; y < 200; ++y)
            for (int x = 0; x < 256; ++x) {
                const glm::dvec2 p = inverse * (glm::dvec2(x + 0.5, y + 0.5) - view.toPixels[2]);
                if (p.x > 1 && p.y > 1 && p.x < mapSide - 1 && p.y < mapSide - 1) {
                    ASSERT_NEAR(drawn.pixel(x, y)[3], 0.5, 1e-3) << i << ": " << x << ' ' << y;
                }
            }
    }
}

TEST_F(Gl, OnlyDamageChanges) {
    const std::vector<PixelRectangle> damage = {
        {3, 4, 20, 9}, {10, 2, 5, 30}, {10, 2, 5, 30}, {-9, 40, 1000, 3}, {20, 20, -4, 5}};
    const auto damaged = [&](int x, int y) {
        return std::ranges::any_of(damage, [&](const PixelRectangle& r) {
            return x >= r.x && y >= r.y && x < r.x + r.width && y < r.y + r.height;
        });
    };
    for (const Asset& asset : assets())
        for (const auto write : {Output::Write::Replace, Output::Write::Over}) {
            const Texture texture = renderer->upload(asset);
            Output output;
            output.write = write;
            const UserFramebuffer whole(GL_RGBA8, side, side, {0, 0.5f, 0.5f, 0.5f});
            renderer->draw(texture, turned(), output);
            const UserFramebuffer part(GL_RGBA8, side, side, {0, 0.5f, 0.5f, 0.5f});
            const std::vector<std::uint8_t> before = part.bytes();
            output.damage = damage;
            renderer->draw(texture, turned(), output);
            const std::vector<std::uint8_t> all = whole.bytes(), drawn = part.bytes();
            for (int y = 0; y < side; ++y)
                for (int x = 0; x < side; ++x)
                    for (int c = 0; c < 4; ++c) {
                        const auto at = std::size_t((y * side + x) * 4 + c);
                        ASSERT_NEAR(drawn[at], damaged(x, y) ? all[at] : before[at], damaged(x, y) ? 1 : 0);
                    }
            output.damage.emplace();
            renderer->draw(texture, turned(), output);
            EXPECT_EQ(part.bytes(), drawn);
        }
}

TEST_F(Gl, EverySampleGetsThePixelsColour) {
    GLint samples = 0;
    glGetInternalformativ(GL_RENDERBUFFER, GL_RGBA8, GL_SAMPLES, 1, &samples);
    if (samples < 2)
        GTEST_SKIP() << "no multisampled framebuffers";
    for (const Asset& asset : assets()) {
        const Texture texture = renderer->upload(asset);
        const UserFramebuffer single(GL_RGBA8, side, side);
        renderer->draw(texture, turned(), {});
        const UserFramebuffer many(GL_RGBA8, side, side, {}, samples);
        renderer->draw(texture, turned(), {});
        const UserFramebuffer resolved(GL_RGBA8, side, side);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, many.framebuffer.get());
        glBlitFramebuffer(0, 0, side, side, 0, 0, side, side, GL_COLOR_BUFFER_BIT, GL_NEAREST);
        const std::vector<std::uint8_t> one = single.bytes(), mean = resolved.bytes();
        for (std::size_t i = 0; i < one.size(); ++i)
            ASSERT_NEAR(one[i], mean[i], 1);
    }
}

TEST_F(Gl, OtherDrawBuffersKeepTheirPixels) {
    const Texture texture = renderer->upload(everyPaint());
    const UserFramebuffer second(GL_RGBA8, side, side, {0.5f, 0.25f, 1, 1}), first(GL_RGBA8, side, side);
    GLint name = 0;
    second.bind();
    glGetFramebufferAttachmentParameteriv(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                                          GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME, &name);
    const std::vector<std::uint8_t> before = second.bytes();
    first.bind();
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_RENDERBUFFER, GLuint(name));
    const GLenum both[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glDrawBuffers(2, both);
    renderer->draw(texture, turned(), {});
    EXPECT_EQ(limit(GL_DRAW_BUFFER1), GL_COLOR_ATTACHMENT1);
    EXPECT_EQ(second.bytes(), before);
    EXPECT_NE(first.bytes(), std::vector<std::uint8_t>(side * side * 4));
}

TEST_F(Gl, ContradictionsAndBadFramebuffersAreErrors) {
    const Texture texture = renderer->upload(disc());
    const UserFramebuffer target(GL_RGBA8, side, side, {1, 0, 0, 1});
    Output output;
    output.alpha = Output::Alpha::Straight;
    output.write = Output::Write::Over;
    EXPECT_THROW(renderer->draw(texture, turned(), output), std::invalid_argument);
    const GLenum none = GL_NONE, first = GL_COLOR_ATTACHMENT0;
    glDrawBuffers(1, &none);
    EXPECT_THROW(renderer->draw(texture, turned(), Output{}), GlError);
    glDrawBuffers(1, &first);
    const UserFramebuffer integers(GL_RGBA8UI, side, side);
    EXPECT_THROW(renderer->draw(texture, turned(), Output{}), GlError);
    GLuint empty = 0;
    glGenFramebuffers(1, &empty);
    const FramebufferHandle owner(empty);
    glBindFramebuffer(GL_FRAMEBUFFER, empty);
    EXPECT_THROW(renderer->draw(texture, turned(), Output{}), GlError);
    EXPECT_EQ(limit(GL_DRAW_FRAMEBUFFER_BINDING), int(empty));
    target.bind();
    EXPECT_EQ(target.bytes()[0], 255);
    EXPECT_NO_THROW(renderer->draw(texture, turned(), Output{}));
}

TEST_F(Gl, FlattenedViewsReplaceByNothing) {
    const Texture texture = renderer->upload(disc());
    const UserFramebuffer target(GL_RGBA8, 4, 4, {1, 1, 1, 1});
    renderer->draw(texture, {4, 4, glm::dmat3x2(1, 1, 2, 2, 0, 0)}, Output{});
    EXPECT_EQ(target.bytes(), std::vector<std::uint8_t>(64));
}

TEST_F(Gl, BitmapsAreRastersInBytes) {
    std::mt19937 random(3);
    for (const Asset& asset : assets())
        for (int i = 0; i < 6; ++i) {
            const Texture texture = renderer->upload(asset);
            const View view = i == 5 ? turnedView(4200, 7, {32, 32}, 60, 0.1) : randomView(random);
            const image::Bitmap expected = image::toBitmap(renderer->render(texture, view)),
                                bitmap = renderer->renderBitmap(texture, view);
            ASSERT_EQ(bitmap.width, expected.width);
            ASSERT_EQ(bitmap.height, expected.height);
            ASSERT_EQ(bitmap.rgba.size(), expected.rgba.size());
            for (std::size_t at = 0; at < bitmap.rgba.size(); ++at)
                if (expected.rgba[at | 3] != 0) {
                    ASSERT_NEAR(bitmap.rgba[at], expected.rgba[at], 1) << at;
                }
        }
}

}  // namespace

}  // namespace vtm::gl
