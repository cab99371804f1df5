// Parts of pictures of 8000 pixels, compiled for that size and drawn by shaders and scanner, against the
// reference: no edge shows that the asset is an approximation.

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <vtm/compiler/view.hpp>
#include <vtm/raster/scan.hpp>
#include "conformance/cases/certify.hpp"
#include "conformance/cases/support.hpp"
#include "conformance/compare/compare.hpp"
#include "conformance/reference/reference.hpp"

namespace vtm::cases {
namespace {

constexpr int picturePixels = 8000, windowPixels = 24, windowCount = 500;
constexpr double maxError = 4, maxRms = 0.3;  // 255ths

std::vector<std::filesystem::path> pictures() {
    return {examplesDirectory() / "gauge.svg", examplesDirectory() / "lighthouse.svg",
            examplesDirectory() / "rose_window.svg"};
}

/// The window of a view whose first pixel is that.
asset::View windowAt(const asset::View& view, scene::Point first) {
    asset::View window{windowPixels, windowPixels, view.toPixels};
    window.toPixels[2] -= first;
    return window;
}

/// Largest error of all windows and root of their mean square.
class Errors {
public:
    void add(const image::Raster& drawn, const image::Raster& truth) {
        const compare::Difference d = compare::compare(drawn, truth);
        max_ = std::max(max_, d.max);
        squares_ += d.rms * d.rms;
        ++count_;
    }
    double max() const { return max_; }
    double rms() const { return std::sqrt(squares_ / count_); }

private:
    double max_ = 0, squares_ = 0;
    int count_ = 0;
};

class LargeView : public testing::TestWithParam<std::filesystem::path> {};
INSTANTIATE_TEST_SUITE_P(Picture, LargeView, testing::ValuesIn(pictures()),
                         [](const auto& tested) { return tested.param.stem().string(); });

TEST_P(LargeView, IsDrawnAsTheReferenceDrawsIt) {
    const scene::Scene scene = loadScene(GetParam());
    const scene::Frame frame = scene::frame({.width = picturePixels}, scene.width, scene.height);
    const compiler::ViewResult made = compiler::compileView(scene, frame);
    const asset::View whole = compiler::viewOf(frame);
    const asset::Scanner scanner(made.result.asset);
    Gl gl;
    const gl::Texture uploaded = gl.renderer.upload(made.result.asset);
    Errors shaders, scanned;
    for (const OutlinePoint& point : Outlines(scene).pointsOn(1, windowCount)) {
        const scene::Point pixel = whole.toPixels * glm::dvec3(point.at, 1);
        const scene::Point first = glm::floor(pixel) - double(windowPixels / 2);
        const asset::View truth = windowAt(whole, first), window = windowAt(made.view, first);
        const image::Raster reference =
            reference::render(scene, {truth.width, truth.height, truth.toPixels}, {.flatness = 1.0 / 1024});
        shaders.add(gl.renderer.render(uploaded, window), reference);
        scanned.add(scanner.draw(window), reference);
    }
    for (const Errors* errors : {&shaders, &scanned}) {
        EXPECT_LE(errors->max(), maxError);
        EXPECT_LE(errors->rms(), maxRms);
    }
    RecordProperty("shaders_max", std::to_string(shaders.max()));
    RecordProperty("shaders_rms", std::to_string(shaders.rms()));
    RecordProperty("scanned_max", std::to_string(scanned.max()));
    RecordProperty("scanned_rms", std::to_string(scanned.rms()));
}

}  // namespace
}  // namespace vtm::cases
