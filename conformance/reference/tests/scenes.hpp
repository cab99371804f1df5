/// \file
/// Small scenes and what their pixels should be.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "conformance/reference/reference.hpp"

namespace vtm::reference {

using namespace scene;

constexpr float tolerance = 1e-6f;
inline const Color red{1, 0, 0, 1}, green{0, 1, 0, 1}, blue{0, 0, 1, 1}, white{1, 1, 1, 1}, black{0, 0, 0, 1};

inline std::shared_ptr<const Path> share(Path path) { return std::make_shared<const Path>(std::move(path)); }

inline Item fill(Path path, Paint paint, float opacity = 1) {
    return {share(std::move(path)), identity, FillRule::NonZero, std::move(paint), opacity};
}

inline Item fillAll(Paint paint, float opacity = 1) {
    return fill(rectangle({-100, -100}, {200, 200}), std::move(paint), opacity);
}

inline Group group(std::vector<Node> children) {
    Group result;
    result.children = std::move(children);
    return result;
}

inline Scene sceneOf(std::vector<Node> nodes, double size = 8) {
    return {size, size, group(std::move(nodes))};
}

inline image::Raster renderAt(const Scene& scene, Mode mode, int size = 8) {
    const double scale = size / scene.width;
    return render(scene, {size, size, scaling(scale, scale)}, {mode, 32});
}

inline void expectPixel(const image::Raster& raster, int x, int y, std::array<double, 4> expected,
                        double within = tolerance) {
    for (int c = 0; c < 4; ++c)
        EXPECT_NEAR(raster.pixel(x, y)[c], expected[std::size_t(c)], within)
            << "pixel " << x << ", " << y << " channel " << c;
}

/// Runs in both modes.
class BothModes : public testing::TestWithParam<Mode> {
protected:
    image::Raster draw(const Scene& scene, int size = 8) { return renderAt(scene, GetParam(), size); }
};

}  // namespace vtm::reference
