// Images under every filter: each engine against the reference, which sums in doubles, and what the filters
// are for against means over the exact footprint.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <string>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <vtm/compiler/compile.hpp>
#include <vtm/raster/evaluate.hpp>
#include <vtm/raster/scan.hpp>
#include "backend_gl/testing.hpp"
#include "conformance/cases/support.hpp"
#include "conformance/reference/reference.hpp"

namespace vtm::cases {
namespace {

using glm::dvec2;
using scene::ImageFilter;

constexpr int raster = 64;

/// Noise in colour and alpha, on sides that are no powers of two.
std::shared_ptr<const image::Bitmap> noise(int width, int height, bool opaque = false) {
    std::mt19937 random(7);
    auto bitmap = std::make_shared<image::Bitmap>(image::Bitmap{width, height, {}});
    for (int i = 0; i < width * height * 4; ++i)
        bitmap->rgba.push_back(opaque && i % 4 == 3 ? 255 : std::uint8_t(random() >> 24));
    return bitmap;
}

/// The picture is all of the bitmap, a unit a pixel.
scene::Scene sceneOf(const std::shared_ptr<const image::Bitmap>& bitmap, ImageFilter filter) {
    scene::Scene scene{double(bitmap->width), double(bitmap->height), {}};
    scene.root.children.push_back({scene::Item{
        std::make_shared<const scene::Path>(scene::rectangle({0, 0}, {bitmap->width, bitmap->height})),
        scene::identity, scene::FillRule::NonZero, scene::ImagePaint{bitmap, filter, scene::identity}, 1}});
    return scene;
}

struct Place {
    const char* name;
    std::array<double, 4> linear;  ///< image to pixels, by columns
};

constexpr double c = 0.8, s = 0.6;  // a turn
constexpr std::array places{Place{"one to one", {1, 0, 0, 1}},
                            Place{"magnified", {3.7, 0, 0, 3.7}},
                            Place{"magnified and turned", {5 * c, 5 * s, -5 * s, 5 * c}},
                            Place{"halved", {0.5, 0, 0, 0.5}},
                            Place{"a little smaller", {0.83, 0, 0, 0.83}},
                            Place{"much smaller", {0.137, 0, 0, 0.137}},
                            Place{"smaller and turned", {0.4 * c, 0.4 * s, -0.4 * s, 0.4 * c}},
                            Place{"sheared", {0.6, 0, 0.5, 0.6}},
                            Place{"mirrored and oblong", {-0.9, 0, 0, 0.2}},
                            Place{"larger one way, smaller the other", {2.5, 0, 0.3, 0.3}}};

/// The middle of the image a little beside the middle of the raster.
asset::View viewOf(const scene::Scene& scene, const Place& place) {
    asset::View view{raster, raster, {}};
    view.toPixels[0] = {place.linear[0], place.linear[1]};
    view.toPixels[1] = {place.linear[2], place.linear[3]};
    const dvec2 middle(scene.width / 2, scene.height / 2);
    view.toPixels[2] = dvec2(raster / 2 + 0.37, raster / 2 - 0.21) - view.toPixels * glm::dvec3(middle, 0);
    return view;
}

reference::View referenceView(const asset::View& view) { return {view.width, view.height, view.toPixels}; }

class ImageFilters : public testing::Test {
protected:
    Gl gl_;
};

/// Where the picture covers the pixel wholly: elsewhere the two modes and the texture mean different things.
bool isInside(const asset::View& view, const scene::Scene& scene, int x, int y) {
    const glm::dmat2 inverse = glm::inverse(glm::dmat2(view.toPixels[0], view.toPixels[1]));
    const dvec2 p = inverse * (dvec2(x + 0.5, y + 0.5) - view.toPixels[2]);
    const dvec2 reach = 0.5 * (glm::abs(inverse[0]) + glm::abs(inverse[1]));
    return p.x >= reach.x && p.y >= reach.y && p.x + reach.x <= scene.width && p.y + reach.y <= scene.height;
}

double worstInside(const image::Raster& a, const image::Raster& b, const asset::View& view,
                   const scene::Scene& scene) {
    double worst = 0;
    for (int y = 0; y < raster; ++y)
        for (int x = 0; x < raster; ++x)
            for (int channel = 0; channel < 4 && isInside(view, scene, x, y); ++channel)
                worst = std::max(worst,
                                 255.0 * std::abs(double(a.pixel(x, y)[channel]) - b.pixel(x, y)[channel]));
    return worst;
}

/// Levels are bytes: half a 255th off, a quarter more where two are blended with weights in single precision.
constexpr double levelMax = 0.75;

TEST_F(ImageFilters, EveryEngineDrawsWhatTheReferenceSums) {
    for (const ImageFilter filter : {ImageFilter::Trilinear, ImageFilter::Bicubic}) {
        const scene::Scene scene = sceneOf(noise(61, 45), filter);
        const asset::Asset exact = compiler::compile(scene).asset;
        compiler::Options layered;
        layered.mode = asset::Mode::Compat;
        const asset::Asset compat = compiler::compile(scene, layered).asset;
        const asset::Scanner scanner(exact);
        gl::test::TextureCanvas texture(exact);
        for (const Place& place : places) {
            SCOPED_TRACE(std::string(place.name) +
                         (filter == ImageFilter::Bicubic ? ", bicubic" : ", trilinear"));
            const asset::View view = viewOf(scene, place);
            const image::Raster truth = reference::render(scene, referenceView(view));
            EXPECT_LE(worstInside(asset::evaluate(exact, view), truth, view, scene), levelMax);
            EXPECT_LE(worstInside(asset::evaluate(compat, view), truth, view, scene), levelMax);
            EXPECT_LE(worstInside(scanner.draw(view), truth, view, scene), levelMax);
            EXPECT_LE(worstInside(gl_.render(exact, view), truth, view, scene), levelMax + 0.5);
            EXPECT_LE(worstInside(gl_.render(compat, view), truth, view, scene), levelMax + 0.5);
            // Further away textures are drawn from their prefilters.
            if (std::string(place.name) != "much smaller") {
                EXPECT_LE(worstInside(texture.draw(view), truth, view, scene), levelMax + 0.5);
            }
            // With its borders, by the bounds of every other picture.
            const compare::Difference d = compare::compare(gl_.render(exact, view), truth);
            EXPECT_LE(d.max, referenceMax);
        }
    }
}

/// Nearest and bilinear images mean the same field at any scale: held at the centres of pixels, where compat
/// mode looks at it.
TEST_F(ImageFilters, NearestAndBilinearAreReadAtThePixelsCentre) {
    for (const ImageFilter filter : {ImageFilter::Nearest, ImageFilter::Bilinear}) {
        const scene::Scene scene = sceneOf(noise(61, 45), filter);
        const asset::Asset asset = compiler::compile(scene).asset;
        const asset::Scanner scanner(asset);
        reference::Options options;
        options.mode = reference::Mode::Compat;
        for (const Place& place : places) {
            SCOPED_TRACE(place.name);
            const asset::View view = viewOf(scene, place);
            const image::Raster truth = reference::render(scene, referenceView(view), options);
            EXPECT_LE(worstInside(asset::evaluate(asset, view), truth, view, scene), 0.1);
            EXPECT_LE(worstInside(scanner.draw(view), truth, view, scene), 0.1);
            // Shaders look at a place up to 2^-16 of a square beside the centre.
            if (filter == ImageFilter::Bilinear) {
                EXPECT_LE(worstInside(gl_.render(asset, view), truth, view, scene), 2);
            }
        }
    }
}

/// Mean of the image's pixels over the footprint of pixel (x, y), by 64 × 64 points.
glm::dvec4 footprintMean(const image::Bitmap& bitmap, const asset::View& view, int x, int y) {
    const glm::dmat2 inverse = glm::inverse(glm::dmat2(view.toPixels[0], view.toPixels[1]));
    glm::dvec4 sum(0);
    constexpr int n = 64;
    for (int i = 0; i < n * n; ++i) {
        const dvec2 pixel(x + (i % n + 0.5) / n, y + (i / n + 0.5) / n);
        const dvec2 p = glm::clamp(inverse * (pixel - view.toPixels[2]), dvec2(0),
                                   dvec2(bitmap.width - 1, bitmap.height - 1));
        const std::uint8_t* rgba =
            &bitmap.rgba[(std::size_t(p.y) * std::size_t(bitmap.width) + std::size_t(p.x)) * 4];
        const glm::dvec4 color = glm::dvec4(rgba[0], rgba[1], rgba[2], rgba[3]) / 255.0;
        sum += glm::dvec4(color.r * color.a, color.g * color.a, color.b * color.a, color.a);
    }
    return sum / double(n * n);
}

double rmsToFootprints(const asset::Scanner& scanner, const image::Bitmap& bitmap, const scene::Scene& scene,
                       const Place& place) {
    const asset::View view = viewOf(scene, place);
    const image::Raster drawn = scanner.draw(view);
    double sum = 0, count = 0;
    for (int y = 0; y < raster; ++y)
        for (int x = 0; x < raster; ++x) {
            if (!isInside(view, scene, x, y))
                continue;
            const glm::dvec4 mean = footprintMean(bitmap, view, x, y);
            for (int channel = 0; channel < 4; ++channel)
                sum += std::pow(255 * (drawn.pixel(x, y)[channel] - mean[channel]), 2);
            count += 4;
        }
    EXPECT_GT(count, 100);
    return std::sqrt(sum / count);
}

/// What minified images are filtered for. Noise is the hardest of pictures: point samples leave nearly all of
/// it.
TEST_F(ImageFilters, MinifiedImagesAreNearTheirMeans) {
    const auto bitmap = noise(211, 173, true);
    for (const Place& place :
         {Place{"quartered", {0.25, 0, 0, 0.25}}, Place{"a sixth, turned", {c / 6, s / 6, -s / 6, c / 6}}}) {
        SCOPED_TRACE(place.name);
        const auto rms = [&](ImageFilter filter) {
            const scene::Scene scene = sceneOf(bitmap, filter);
            return rmsToFootprints(asset::Scanner(compiler::compile(scene).asset), *bitmap, scene, place);
        };
        const double bilinear = rms(ImageFilter::Bilinear), trilinear = rms(ImageFilter::Trilinear);
        EXPECT_LE(trilinear, bilinear / 6);
        EXPECT_DOUBLE_EQ(rms(ImageFilter::Bicubic), trilinear);  // beyond one level the same filter
    }
}

/// Rows of colours under noise along them, which a squeeze along the rows evens out: the rows stay apart.
TEST_F(ImageFilters, OblongFootprintsAreNotBlurredAcross) {
    auto bitmap = std::make_shared<image::Bitmap>(*noise(211, 61, true));
    for (int y = 0; y < bitmap->height; ++y)
        for (int x = 0; x < bitmap->width * 4; ++x) {
            std::uint8_t& byte = bitmap->rgba[std::size_t(y * bitmap->width * 4 + x)];
            if (x % 4 != 3)
                byte = std::uint8_t(byte / 4 + (std::sin(y) > 0 ? 190 : 0));
        }
    const scene::Scene scene = sceneOf(bitmap, ImageFilter::Trilinear);
    const asset::Scanner scanner(compiler::compile(scene).asset);
    for (const double squeeze : {2.5, 4.0, 8.0, 13.0})
        for (const auto& [across, along] :
             {std::pair{dvec2(1, 0), dvec2(0, 1)}, {dvec2(c, s), dvec2(-s, c)}}) {
            SCOPED_TRACE(squeeze);
            const dvec2 x = across / squeeze;
            const Place place{"", {x.x, x.y, along.x, along.y}};
            EXPECT_LE(rmsToFootprints(scanner, *bitmap, scene, place), 4);  // 37 and more, were it blurred
        }
}

/// The brightness of a picture does not depend on how small it is shown.
TEST_F(ImageFilters, TheMeanStays) {
    const auto bitmap = noise(64, 64, true);
    const scene::Scene scene = sceneOf(bitmap, ImageFilter::Trilinear);
    const asset::Scanner scanner(compiler::compile(scene).asset);
    glm::dvec4 whole(0);
    for (std::size_t i = 0; i < bitmap->rgba.size(); ++i)
        whole[int(i % 4)] += bitmap->rgba[i] / 4096.0;
    for (const double scale : {0.9, 0.6, 0.45, 0.3, 0.17, 0.05}) {
        asset::View view{raster, raster, {scale, 0, 0, scale, 0.3, 0.4}};
        const image::Raster drawn = scanner.draw(view);
        glm::dvec4 sum(0);
        for (std::size_t i = 0; i < drawn.rgba.size(); ++i)
            sum[int(i % 4)] += 255.0 * drawn.rgba[i] / (4096 * scale * scale);
        for (int channel = 0; channel < 4; ++channel)
            EXPECT_NEAR(sum[channel], whole[channel], 1.5) << scale;
    }
}

/// From level to level, and from magnified to minified, nothing jumps.
TEST_F(ImageFilters, ZoomingIsContinuous) {
    for (const ImageFilter filter : {ImageFilter::Trilinear, ImageFilter::Bicubic}) {
        const auto bitmap = noise(61, 45);
        const scene::Scene scene = sceneOf(bitmap, filter);
        const asset::Scanner scanner(compiler::compile(scene).asset);
        for (const double scale : {1.0, 0.5, 0.25, 0.125}) {
            const Place before{"", {scale * 1.00001, 0, 0, scale * 1.00001}};
            const Place after{"", {scale / 1.00001, 0, 0, scale / 1.00001}};
            const asset::View view = viewOf(scene, before);
            EXPECT_LE(worstInside(scanner.draw(view), scanner.draw(viewOf(scene, after)), view, scene), 1)
                << scale;
        }
    }
}

}  // namespace
}  // namespace vtm::cases
