/// Colours known by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>

#include "conformance/reference/reference.hpp"

namespace vtm::reference {
namespace {

using namespace scene;

constexpr float tolerance = 1e-6f;
const Color red{1, 0, 0, 1}, green{0, 1, 0, 1}, blue{0, 0, 1, 1}, white{1, 1, 1, 1}, black{0, 0, 0, 1};

std::shared_ptr<const Path> share(Path path) { return std::make_shared<const Path>(std::move(path)); }

Item fill(Path path, Paint paint, float opacity = 1) {
    return {share(std::move(path)), identity, FillRule::NonZero, std::move(paint), opacity};
}

Item fillAll(Paint paint, float opacity = 1) {
    return fill(rectangle({-100, -100}, {200, 200}), std::move(paint), opacity);
}

Group group(std::vector<Node> children) {
    Group result;
    result.children = std::move(children);
    return result;
}

Scene sceneOf(std::vector<Node> nodes, double size = 8) { return {size, size, group(std::move(nodes))}; }

image::Raster renderAt(const Scene& scene, Mode mode, int size = 8) {
    const double scale = size / scene.width;
    return render(scene, {size, size, scaling(scale, scale)}, {mode, 32});
}

void expectPixel(const image::Raster& raster, int x, int y, std::array<double, 4> expected,
                 double within = tolerance) {
    for (int c = 0; c < 4; ++c)
        EXPECT_NEAR(raster.pixel(x, y)[c], expected[std::size_t(c)], within)
            << "pixel " << x << ", " << y << " channel " << c;
}

/// Runs in both modes; their names show where one fails.
class BothModes : public testing::TestWithParam<Mode> {
protected:
    image::Raster draw(const Scene& scene, int size = 8) { return renderAt(scene, GetParam(), size); }
};

INSTANTIATE_TEST_SUITE_P(Render, BothModes, testing::Values(Mode::Exact, Mode::Compat),
                         [](const auto& mode) { return mode.param == Mode::Exact ? "Exact" : "Compat"; });

TEST_P(BothModes, EmptySceneIsTransparent) {
    for (const float v : draw(sceneOf({})).rgba)
        EXPECT_EQ(v, 0);
}

TEST_P(BothModes, CoverageOfOneShape) {
    const auto raster =
        draw(sceneOf({{fill(rectangle({1.5, 2}, {4, 3.25}), Color{1, 0.5f, 0, 0.5f}, 0.5f)}}));
    expectPixel(raster, 2, 2, {0.25, 0.125, 0, 0.25});
    expectPixel(raster, 1, 2, {0.125, 0.0625, 0, 0.125});
    expectPixel(raster, 1, 3, {0.03125, 0.015625, 0, 0.03125});
    expectPixel(raster, 0, 2, {0, 0, 0, 0});
    expectPixel(raster, 4, 2, {0, 0, 0, 0});
}

TEST_P(BothModes, LaterLiesOnTop) {
    const auto raster = draw(sceneOf({{fillAll(red)}, {fillAll(blue, 0.25f)}}));
    expectPixel(raster, 3, 3, {0.75, 0, 0.25, 1});
}

}  // namespace
}  // namespace vtm::reference
