// The two sides of a selection share a boundary: no ground may show through there. SVG has no selections;
// shapes that abut in SVG files are the suite conformance/suites/regions.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <vtm/compiler/compile.hpp>
#include "conformance/cases/support.hpp"
#include "conformance/reference/reference.hpp"

namespace vtm::cases {
namespace {

using scene::Path;
using scene::Point;

constexpr double pi = 3.14159265358979323846;
constexpr double side = 256;
constexpr Point centre{side / 2, side / 2};
constexpr int views = 12, raster = 192;
constexpr double leakBound = 1;  // 1/255

scene::Node filled(Path path, const scene::Affine& transform, const scene::Color& color) {
    scene::Item item;
    item.path = std::make_shared<Path>(std::move(path));
    item.transform = transform;
    item.geometry = scene::FillRule::NonZero;
    item.paint = color;
    return {item};
}

/// A white ground: what leaks shows at full contrast.
scene::Scene whiteGround() {
    scene::Scene scene;
    scene.width = scene.height = side;
    scene.root.children.push_back(
        filled(scene::rectangle({0, 0}, {side, side}), scene::identity, {1, 1, 1, 1}));
    return scene;
}

scene::Affine turned(double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    const scene::Affine rotation{c, s, -s, c, 0, 0};
    return scene::compose(scene::translation(centre.x, centre.y),
                          scene::compose(rotation, scene::translation(-centre.x, -centre.y)));
}

/// Shares of white in pixels that lie wholly inside `inside`, which the shapes cover together.
double leak(const image::Raster& drawn, const std::vector<double>& inside) {
    double worst = 0;
    for (std::size_t i = 0; i < inside.size(); ++i)
        if (inside[i] > 1 - 1e-9)
            worst = std::max({worst, double(drawn.rgba[4 * i]), 1 - double(drawn.rgba[4 * i + 3])});
    return 255 * worst;
}

class Selection : public testing::Test {
protected:
    /// The worst over views that turn the picture on the raster, and the shapes in the picture.
    template <class Make>
    double worstLeak(const Path& inside, asset::Mode mode, Make make) {
        compiler::Options options;
        options.mode = mode;
        double worst = 0;
        for (int i = 0; i < views; ++i) {
            const scene::Affine inPicture = turned(angle());
            const asset::Asset asset = compiler::compile(make(inPicture), options).asset;
            const scene::Affine toPixels = view(std::exp2(i % 4 - 2));
            const auto covered = reference::fillCoverage(inside, inPicture, scene::FillRule::NonZero,
                                                         {raster, raster, toPixels});
            worst = std::max(worst, leak(gl_.render(asset, {raster, raster, toPixels}), covered));
        }
        return worst;
    }

private:
    /// The picture's centre lands near the raster's.
    scene::Affine view(double scale) {
        const Point middle{raster / 2.0 + offset(), raster / 2.0 + offset()};
        return scene::compose(
            scene::translation(middle.x, middle.y),
            scene::compose(scene::scaling(scale, scale),
                           scene::compose(scene::translation(-centre.x, -centre.y), turned(angle()))));
    }
    double angle() { return std::uniform_real_distribution<double>(0, 2 * pi)(random_); }
    double offset() { return std::uniform_real_distribution<double>(-1, 1)(random_); }

    Gl gl_;
    std::mt19937 random_{2005};  // fixed, so that a failure can be repeated
};

/// Black inside of a bow of cubics and blue outside of it, on white: two sides with one boundary.
scene::Scene selectedOnWhite(const scene::Affine& transform) {
    const Path bow{scene::MoveTo{{40, 128}}, scene::CubicTo{{60, 10}, {170, 60}, {216, 128}},
                   scene::CubicTo{{150, 150}, {190, 240}, {40, 128}}, scene::Close{}};
    const Path all = scene::rectangle({-500, -500}, {1000, 1000});
    scene::Select select{
        {std::make_shared<Path>(bow), transform, scene::FillRule::NonZero}, nullptr, nullptr};
    scene::Group content;
    content.children.push_back(filled(all, scene::identity, {0, 0, 0, 1}));
    select.inside = std::make_shared<scene::Group>(content);
    content.children[0] = filled(all, scene::identity, {0, 0, 1, 1});
    select.outside = std::make_shared<scene::Group>(content);
    scene::Scene scene = whiteGround();
    scene.root.children.push_back({select});
    return scene;
}

/// Red is white's alone. In compat mode, too, the sides' shares add up to one.
TEST_F(Selection, DoesNotLeakBetweenItsSides) {
    const Path inside = scene::rectangle({60, 60}, {196, 196});  // inside the picture at any angle
    EXPECT_LE(worstLeak(inside, asset::Mode::Exact, selectedOnWhite), leakBound);
    EXPECT_LE(worstLeak(inside, asset::Mode::Compat, selectedOnWhite), leakBound);
}

}  // namespace
}  // namespace vtm::cases
