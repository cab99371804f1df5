// Pictures with filters through a renderer's passes, beside the CPU's. The suite `filters` compares both with
// the reference, primitive by primitive.

#include <vtm/compiler/compile.hpp>
#include <vtm/raster/evaluate.hpp>
#include <vtm/svg/load.hpp>

#include "backend_gl/output/target.hpp"
#include "backend_gl/tests/output_support.hpp"
#include "raster/filter_place.hpp"

namespace vtm::gl {
namespace {

/// A shadow within a blurred group, light and noise: pictures in pictures, several inputs, both colour
/// spaces.
constexpr std::string_view drawing = R"(<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 64 64'>
  <filter id='shadow'><feDropShadow dx='3' dy='2' stdDeviation='2'/></filter>
  <filter id='marble' color-interpolation-filters='sRGB'>
    <feTurbulence baseFrequency='.1' numOctaves='3' result='noise'/>
    <feDisplacementMap in='SourceGraphic' in2='noise' scale='6' xChannelSelector='R' yChannelSelector='G'/>
    <feMorphology operator='dilate' radius='1.3'/>
    <feMerge><feMergeNode/><feMergeNode in='SourceGraphic'/><feMergeNode in='noise'/></feMerge>
  </filter>
  <rect width='64' height='40' fill='#cdf'/>
  <g opacity='.8' filter='blur(1px)'>
    <circle cx='24' cy='26' r='14' fill='#c33' filter='url(#shadow)'/>
    <path d='M30 4 60 50 20 60z' fill='#2a6' fill-opacity='.7' filter='url(#marble)'/>
  </g>
  <circle cx='44' cy='44' r='9' fill='none' stroke='#224' stroke-width='3' style='mix-blend-mode:multiply'/>
</svg>)";

Asset assetOf(std::string_view text, asset::Mode mode) {
    compiler::Options options;
    options.mode = mode;
    const std::vector<std::uint8_t> bytes(text.begin(), text.end());
    return compiler::compile(svg::load(bytes).scene, options).asset;
}

constexpr asset::Mode bothModes[] = {asset::Mode::Exact, asset::Mode::Compat};
constexpr double twins = 2 * byteStep;

TEST_F(Gl, FiltersAreThoseOfTheCpu) {
    for (const asset::Mode mode : bothModes) {
        const Asset asset = assetOf(drawing, mode);
        ASSERT_FALSE(asset.filters.empty());
        const Texture texture = renderer->upload(asset);
        for (const View& view : {View{64, 64}, View{100, 80, {1.5, 0, 0, 1.5, 2, -7}}, turned()})
            EXPECT_LE(worst(renderer->render(texture, view), asset::evaluate(asset, view), identity), twins);
    }
}

/// Also where the driver has no float targets (MESA_EXTENSION_OVERRIDE takes them away). Layers of bytes are
/// too coarse for what is stored in linear light.
TEST_F(Gl, FiltersAreDrawnIntoBytes) {
    for (const asset::Mode mode : bothModes) {
        const Asset asset = assetOf(drawing, mode);
        const image::Raster picture = asset::evaluate(asset, turned());
        const Texture texture = renderer->upload(asset);
        for (const GLenum format : {GL_RGBA8, GL_SRGB8_ALPHA8}) {
            if (format != GL_RGBA8 && !floatFormat())
                continue;
            const UserFramebuffer target(format, side, side);
            Output output;
            output.firstRow = Output::FirstRow::Bottom;
            renderer->draw(texture, turned(), output);
            const auto stored = [&](const Color& c) {
                if (format == GL_RGBA8)
                    return c;
                const Color linear = toLinear(c);
                return Color{encoded(linear[0]), encoded(linear[1]), encoded(linear[2]), c[3]};
            };
            EXPECT_LE(worst(rasterOf(target), picture, stored), 3 * byteStep) << format;
        }
    }
}

/// Filters read beyond the boxes that are drawn.
TEST_F(Gl, DamageOfFilteredPicturesIsThePicture) {
    const Asset asset = assetOf(drawing, asset::Mode::Exact);
    const Texture texture = renderer->upload(asset);
    const UserFramebuffer whole(GL_RGBA8, side, side);
    renderer->draw(texture, turned(), {});
    const image::Raster expected = rasterOf(whole);
    const UserFramebuffer parts(GL_RGBA8, side, side);
    for (int y = 0; y < side; y += 40)
        for (int x = 0; x < side; x += 28) {
            parts.bind();
            Output output;
            output.damage = {{{x, y, x + 28, y + 40}}};
            renderer->draw(texture, turned(), output);
        }
    EXPECT_LE(worst(rasterOf(parts), expected, identity), byteStep * 1.01);
}

/// Pictures of groups that nothing of is seen have no pixels.
TEST_F(Gl, FiltersOutOfViewDrawNothing) {
    for (const asset::Mode mode : bothModes) {
        const Asset asset = assetOf(drawing, mode);
        const Texture texture = renderer->upload(asset);
        const View away{32, 32, {1, 0, 0, 1, 1000, 1000}};
        for (const float channel : renderer->render(texture, away).rgba)
            ASSERT_EQ(channel, 0);
    }
}

/// A view that would need wider layers than the driver has makes them coarser.
TEST_F(Gl, LayersFitTheDriver) {
    const Asset asset = assetOf(drawing, asset::Mode::Exact);
    constexpr int maxSide = 40;
    for (const asset::Filter& filter : asset.filters) {
        const asset::FilterPlace place =
            asset::placeOf(asset, filter, View{300, 300, {5, 0, 0, 5, 0, 0}}, maxSide);
        for (const auto* boxes : {&place.needed, &place.pictures})
            for (const asset::PixelBox& box : *boxes) {
                EXPECT_LE(box.width(), maxSide);
                EXPECT_LE(box.height(), maxSide);
            }
    }
}

}  // namespace
}  // namespace vtm::gl
