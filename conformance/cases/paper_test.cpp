// Paper mode against exact coverage: how far the paper's anti-aliasing is off, and no further.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "conformance/cases/support.hpp"
#include "conformance/compare/compare.hpp"
#include "conformance/reference/reference.hpp"
#include "paper/compile.hpp"
#include "paper/evaluate.hpp"
#include "paper/gl/renderer.hpp"

namespace vtm::cases {
namespace {

using scene::Path;
using scene::Point;

constexpr double side = 256, pi = std::numbers::pi;
constexpr int raster = 128, views = 20;

struct Errors {
    double max = 0, rms = 0;
};

/// Over random views in which a unit is `zoom` pixels, give or take a quarter.
Errors errorsOf(const Path& path, Point focus, double zoom) {
    const auto paper = paper::compile(sceneOf(path, scene::FillRule::EvenOdd, side));
    EXPECT_EQ(paper.approximatedCells(), 0u);
    std::mt19937 random(1);  // fixed, so that a failure can be repeated
    std::uniform_real_distribution<double> unit(0, 1);
    Errors errors;
    double squares = 0;
    std::size_t edges = 0;
    for (int i = 0; i < views; ++i) {
        const double angle = 2 * pi * unit(random), scale = zoom * (0.75 + 0.5 * unit(random));
        const Point x = scale * Point(std::cos(angle), std::sin(angle)), y(-x.y, x.x);
        const Point to = Point(raster / 2 + unit(random), raster / 2 + unit(random));
        const asset::View view{raster, raster, {x, y, to - focus.x * x - focus.y * y}};
        const auto drawn = paper::evaluate(paper.asset, view);
        const auto truth = reference::fillCoverage(path, scene::identity, scene::FillRule::EvenOdd,
                                                   {raster, raster, view.toPixels});
        for (std::size_t p = 0; p < truth.size(); ++p) {
            const double error = 255 * std::abs(double(drawn.rgba[4 * p + 3]) - truth[p]);
            errors.max = std::max(errors.max, error);
            if (truth[p] > 0 && truth[p] < 1)
                squares += error * error, ++edges;
        }
    }
    errors.rms = std::sqrt(squares / double(std::max<std::size_t>(edges, 1)));
    return errors;
}

Path circle(double radius) {
    const Point left{128 - radius, 128}, right{128 + radius, 128};
    return {scene::MoveTo{left}, scene::ArcTo{{radius, radius}, 0, false, true, right},
            scene::ArcTo{{radius, radius}, 0, false, true, left}, scene::Close{}};
}

Path annulus(double outer, double inner) {
    Path path = circle(outer);
    const Path hole = circle(inner);
    path.insert(path.end(), hole.begin(), hole.end());
    return path;
}

const Path halfPlane = scene::polygon({{-900, 100}, {900, 180}, {900, 1500}, {-900, 1500}});
const Path corner = scene::polygon({{128, 128}, {900, 250}, {900, 1500}, {200, 900}});

constexpr Point onDisc{128 + 100 * 0.5403, 128 + 100 * 0.8415};

/// 0.5 - h is off by 10.9 on a half plane at 22.5 degrees; the compiler's tolerance moves the edge by
/// some pixels, of which each counts 255.
double edgeBound(double zoom) { return 10.9 + 255 * 1.25 * zoom * side * paper::CompileOptions().tolerance; }

TEST(PaperRow6, EdgesAreOffByTheEstimatorAlone) {
    for (const double zoom : {1.0, 2.0, 4.0})
        for (const auto& [path, focus] :
             {std::pair(halfPlane, Point(128, 145.7)), std::pair(circle(100), onDisc),
              std::pair(annulus(100, 80), onDisc)}) {
            const Errors errors = errorsOf(path, focus, zoom);
            EXPECT_LE(errors.max, edgeBound(zoom)) << "zoom " << zoom;
            EXPECT_LE(errors.rms, 5.5) << "zoom " << zoom;
        }
}

TEST(PaperRow6, CornersAreOffByHalfAPixel) {
    for (const double zoom : {1.0, 4.0, 64.0}) {
        const Errors errors = errorsOf(corner, {128, 128}, zoom);
        EXPECT_LE(errors.max, 128) << "zoom " << zoom;
        EXPECT_LE(errors.rms, 6.5) << "zoom " << zoom;
    }
}

/// A trilinear mip is soft: up to a quarter of the range at an edge.
TEST(PaperRow7, MinifiedShapesAreSoftAndNotAliased) {
    for (const double zoom : {0.03, 0.06, 0.125, 0.25, 0.5})
        for (const Path& path : {circle(100), annulus(100, 80), annulus(100, 98)})
            EXPECT_LE(errorsOf(path, {128, 128}, zoom).max, 100) << "zoom " << zoom;
}

/// A ring of a fiftieth of a pixel in width keeps its ink on the mean over places on the raster. One place
/// may be off by a fifth: 8 bits, and a filter of one to two pixels sampled once a pixel. (Further out
/// the frame of the picture, some pixels in size, cuts the filter off.)
TEST(PaperRow7, ThinRingsKeepTheirArea) {
    const Path ring = annulus(100, 98);
    const auto paper = paper::compile(sceneOf(ring, scene::FillRule::EvenOdd, side));
    for (const double zoom : {0.05, 0.1, 0.2}) {
        const double truth = pi * (100 * 100 - 98 * 98) * zoom * zoom;
        double sum = 0;
        constexpr int places = 8;
        for (int i = 0; i < places * places; ++i) {
            const Point shift(double(i % places) / places, double(i / places) / places);
            const asset::View view{64, 64, {zoom, 0, 0, zoom, 3 + shift.x, 5 + shift.y}};
            const auto drawn = paper::evaluate(paper.asset, view);
            double ink = 0;
            for (std::size_t p = 3; p < drawn.rgba.size(); p += 4)
                ink += drawn.rgba[p];
            EXPECT_NEAR(ink, truth, 0.2 * truth) << "zoom " << zoom << ", place " << i;
            sum += ink / (places * places);
        }
        EXPECT_NEAR(sum, truth, 0.01 * truth) << "zoom " << zoom;
    }
}

image::Raster reference(const scene::Scene& scene, const asset::View& view) {
    return reference::render(scene, {view.width, view.height, view.toPixels});
}

/// Mean errors, in 1/255, of whole pictures.
class PaperPicture : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Drawing, PaperPicture,
                         testing::Values("lighthouse", "rose_window", "gauge", "planet"),
                         [](const auto& tested) { return std::string(tested.param); });

TEST_P(PaperPicture, IsRecognised) {
    const scene::Scene scene = loadScene(examplesDirectory() / (std::string(GetParam()) + ".svg"));
    const asset::View view = wholePicture(scene, 256);
    const auto paper = paper::compile(scene);
    EXPECT_LE(compare::compare(paper::evaluate(paper.asset, view), reference(scene, view)).mean, 0.6);
}

/// Turned, magnified and minified: the shader and its twin on the CPU.
std::vector<asset::View> viewsOf(const scene::Scene& scene) {
    const asset::View whole = wholePicture(scene, 160);
    asset::View turned = whole, near = whole, far = whole;
    turned.toPixels = {0.3, 0.2, -0.25, 0.28, 40, -10};
    near.toPixels = {9, 0, 0, 9, -4.5 * scene.width, -4.5 * scene.height};
    far.toPixels = {0.05, 0, 0, 0.05, 20, 20};
    return {whole, turned, near, far};
}

TEST_P(PaperPicture, IsTheSameOnTheGpu) {
    const gl::Context context;
    paper::Renderer renderer;
    const scene::Scene scene = loadScene(examplesDirectory() / (std::string(GetParam()) + ".svg"));
    const auto paper = paper::compile(scene);
    const paper::Texture texture(paper.asset);
    for (const asset::View& view : viewsOf(scene)) {
        const compare::Difference d =
            compare::compare(renderer.render(texture, view), paper::evaluate(paper.asset, view));
        EXPECT_LE(d.max, assetMax) << "at " << d.worstX << ", " << d.worstY;
    }
}

/// At 64 px the trilinear mip of 182 masks, one over the other, is what is seen.
TEST(PaperCorpus, TheTigerIsRecognised) {
    const auto path = sharedDirectory() / "corpus/tiger.svg";
    if (!std::filesystem::exists(path))
        GTEST_SKIP() << path << " is absent";
    const scene::Scene scene = loadScene(path);
    const auto paper = paper::compile(scene);
    EXPECT_LE(paper.approximatedCells(), 0.02 * double(paper::summarize(paper.asset).cells));
    for (const auto& [size, mean] : {std::pair(512, 2.0), std::pair(64, 12.0)}) {
        const asset::View view = wholePicture(scene, size);
        const double error =
            compare::compare(paper::evaluate(paper.asset, view), reference(scene, view)).mean;
        EXPECT_LE(error, mean) << size << " px";
    }
}

}  // namespace
}  // namespace vtm::cases
