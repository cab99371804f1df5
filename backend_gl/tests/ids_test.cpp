// Numbers by pixel against asset::paintAt and compiler::itemAt.
#include <vtm/gl/ids.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <stdexcept>

#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include <vtm/compiler/pick.hpp>
#include <vtm/raster/paint_at.hpp>
#include "asset/testing.hpp"
#include "backend_gl/core/gl.hpp"
#include "backend_gl/tests/gl_fixture.hpp"
#include "raster/testing_views.hpp"

namespace vtm::gl {
namespace {

using asset::Asset;
using asset::View;
using namespace asset::test;

std::vector<std::uint32_t> numbersOf(const Asset& asset) {
    std::vector<std::uint32_t> numbers(asset.paints.size());
    std::iota(numbers.begin(), numbers.end(), 0u);
    return numbers;
}

/// The paint at a pixel's centre, unless a boundary is nearer than 1/64 pixel.
std::optional<std::uint32_t> clearPaint(const Asset& asset, const View& view, int x, int y) {
    const glm::dmat2 inverse = glm::inverse(glm::dmat2(view.toPixels[0], view.toPixels[1]));
    const auto at = [&](double dx, double dy) {
        return asset::paintAt(asset, inverse * (glm::dvec2(x + 0.5 + dx, y + 0.5 + dy) - view.toPixels[2]));
    };
    constexpr double near = 1.0 / 64;
    const std::uint32_t paint = at(0, 0);
    for (int i = 0; i < 8; ++i)
        if (at(near * std::cos(i * 0.785), near * std::sin(i * 0.785)) != paint)
            return std::nullopt;
    return paint;
}

TEST_F(Gl, IdsAreThoseOfTheEvaluator) {
    IdRenderer ids;
    std::mt19937 random(17);
    for (const Asset& asset : {halfPlane(), wedge(), strip(), threeRegions(), disc(), twoLevels()}) {
        const IdTexture texture = ids.upload(asset, numbersOf(asset));
        int compared = 0, all = 0;
        for (int i = 0; i < 6; ++i) {
            const View view = randomView(random);
            const std::vector<std::uint32_t> got = ids.render(texture, view);
            for (int y = 0; y < view.height; ++y)
                for (int x = 0; x < view.width; ++x, ++all)
                    if (const auto paint = clearPaint(asset, view, x, y)) {
                        ASSERT_EQ(got[std::size_t(y * view.width + x)], *paint) << i << ": " << x << ' ' << y;
                        ++compared;
                    }
        }
        EXPECT_GT(compared, all * 9 / 10);
    }
}

TEST_F(Gl, IdsOfADeepZoom) {
    IdRenderer ids;
    const Asset asset = disc();
    const IdTexture texture = ids.upload(asset, numbersOf(asset));
    // On the disc's rightmost arc, 2^16 times.
    const View view = turnedView(64, 64, {mapSide * (32768.0 + 25000) / 65535, mapSide / 2}, 65536, 0.5);
    const std::vector<std::uint32_t> got = ids.render(texture, view);
    bool inside = false, outside = false;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            if (const auto paint = clearPaint(asset, view, x, y)) {
                // A pixel is 2^-22 of the leaf: numbers are right but for some pixels at the boundary.
                inside |= *paint != 0;
                outside |= *paint == 0;
            }
    EXPECT_TRUE(inside && outside);
    EXPECT_TRUE(std::ranges::find(got, 0u) != got.end() && std::ranges::find(got, 1u) != got.end());
}

TEST_F(Gl, IdsOfItems) {
    scene::Scene scene{64, 64, {}};
    for (int i = 0; i < 40; ++i) {
        scene::Item item;
        const glm::dvec2 corner(i * 7 % 50, i * 13 % 50);
        scene::Path path{scene::MoveTo{corner},
                         scene::CubicTo{corner + glm::dvec2(20, -5), corner + glm::dvec2(5, 20),
                                        corner + glm::dvec2(14, 14)},
                         scene::LineTo{corner + glm::dvec2(0, 12)}, scene::Close{}};
        item.path = std::make_shared<scene::Path>(std::move(path));
        item.geometry = scene::FillRule::NonZero;
        item.paint = scene::Color{1, 0, 0, 0.5f};
        scene.root.children.push_back({std::move(item)});
    }
    const compiler::PickMap map = compiler::compilePickMap(scene);
    std::vector<std::uint32_t> numbers;
    for (const std::optional<std::uint32_t>& item : map.itemOfPaint)
        numbers.push_back(item ? *item + 1 : 0);
    IdRenderer ids;
    const View view = turnedView(200, 200, {32, 32}, 2.7, 0.3);
    const std::vector<std::uint32_t> got = ids.render(ids.upload(map.asset, numbers), view);
    std::set<std::uint32_t> seen;
    for (int y = 0; y < 200; ++y)
        for (int x = 0; x < 200; ++x)
            if (const auto paint = clearPaint(map.asset, view, x, y)) {
                ASSERT_EQ(got[std::size_t(y * 200 + x)], numbers[*paint]) << x << ' ' << y;
                seen.insert(numbers[*paint]);
            }
    EXPECT_GT(seen.size(), 30u);
}

/// Triangles whose corners are centres of pixels, so that many pixels lie on ends of pieces and on
/// boundaries.
TEST_F(Gl, IdsOnBoundariesAreThoseOfARegionThere) {
    scene::Scene scene{64, 64, {}};
    for (int i = 0; i < 60; ++i) {
        scene::Item item;
        const glm::dvec2 corner(i * 7 % 47 + 0.5, i * 13 % 47 + 0.5);
        scene::Path path{scene::MoveTo{corner}, scene::LineTo{corner + glm::dvec2(16, i % 5)},
                         scene::LineTo{corner + glm::dvec2(i % 7, 16)}, scene::Close{}};
        item.path = std::make_shared<scene::Path>(std::move(path));
        item.geometry = scene::FillRule::NonZero;
        item.paint = scene::Color{1, 0, 0, 1};
        scene.root.children.push_back({std::move(item)});
    }
    const asset::Asset asset = compiler::compilePickMap(scene).asset;
    IdRenderer ids;
    const View view{64, 64, {1, 0, 0, 1, 0, 0}};
    const std::vector<std::uint32_t> got = ids.render(ids.upload(asset, numbersOf(asset)), view);
    int onBoundaries = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            std::set<std::uint32_t> near;
            for (int i = 0; i < 256; ++i) {
                const double angle = i * 2 * 3.14159265 / 256;
                near.insert(asset::paintAt(asset, glm::dvec2(x + 0.5, y + 0.5) +
                                                      1e-3 * glm::dvec2(std::cos(angle), std::sin(angle))));
            }
            onBoundaries += near.size() > 1;
            EXPECT_TRUE(near.contains(got[std::size_t(y * 64 + x)])) << x << ' ' << y;
        }
    EXPECT_GT(onBoundaries, 300);
}

TEST_F(Gl, IdsGoIntoUsersFramebuffersOfIntegers) {
    IdRenderer ids;
    const IdTexture texture = ids.upload(disc(), numbersOf(disc()));
    const View view{16, 16, {0.25, 0, 0, 0.25, 0, 0}};
    const std::vector<std::uint32_t> expected = ids.render(texture, view);
    GLuint names[2];
    glGenRenderbuffers(1, names);
    glGenFramebuffers(1, names + 1);
    const FramebufferHandle owner(names[1]);
    glBindRenderbuffer(GL_RENDERBUFFER, names[0]);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_R32UI, 16, 16);
    glBindFramebuffer(GL_FRAMEBUFFER, names[1]);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, names[0]);
    ids.draw(texture, view);
    std::vector<std::uint32_t> got(16 * 16 * 4);
    glReadPixels(0, 0, 16, 16, GL_RGBA_INTEGER, GL_UNSIGNED_INT, got.data());
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_EQ(got[4 * i], expected[i]);
    glDeleteRenderbuffers(1, names);
    const UserFramebuffer colours(GL_RGBA8, 16, 16);
    EXPECT_THROW(ids.draw(texture, view), GlError);
    EXPECT_THROW(ids.upload(layers(), numbersOf(layers())), std::invalid_argument);
    EXPECT_THROW(ids.upload(disc(), {}), std::invalid_argument);
}

}  // namespace
}  // namespace vtm::gl
