// The repeated pattern of the paper's row 11 in its four forms, against the mask itself.

#include "paper/gl/pattern.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "backend_gl/tests/gl_fixture.hpp"
#include "paper/compile.hpp"
#include "paper/evaluate.hpp"

namespace vtm::paper {

using namespace gl;
namespace {

using glm::dvec2;

/// A star with a curved side, so that there are corners, curves and squares of every kind.
Mask starMask() {
    scene::Path path;
    for (int i = 0; i < 10; ++i) {
        const double angle = i * 0.6283, radius = i % 2 == 0 ? 44 : 20;
        const scene::Point p(50 + radius * std::cos(angle), 50 + radius * std::sin(angle));
        if (i == 0)
            path.push_back(scene::MoveTo{p});
        else if (i % 3 == 0)
            path.push_back(scene::CubicTo{{50, 50}, {60, 40}, p});
        else
            path.push_back(scene::LineTo{p});
    }
    path.push_back(scene::Close{});
    scene::Scene scene{100, 100, {}};
    scene.root.children.push_back({scene::Item{std::make_shared<const scene::Path>(path), scene::identity,
                                               scene::FillRule::NonZero, scene::Color{}, 1}});
    return compile(scene).asset.masks.at(0);
}

/// `periods` along the raster, turned.
asset::View viewOf(double periods, double angle) {
    const double scale = 64 / periods, c = scale * std::cos(angle), s = scale * std::sin(angle);
    return {64, 64, {c, s, -s, c, 3.3, 5.7}};
}

/// The mask's point under a pixel, and how many mask units a pixel has.
struct Looked {
    dvec2 point;
    Footprint pixel;
};
Looked lookedAt(const Mask& mask, const asset::View& view, int x, int y) {
    const glm::dmat2 linear(view.toPixels[0], view.toPixels[1]);
    const dvec2 st = glm::inverse(linear) * (dvec2(x + 0.5, y + 0.5) - view.toPixels[2]);
    return {dvec2(mask.x, mask.y) + (st - glm::floor(st)) * mask.side, Footprint(linear / mask.side)};
}

using Patterns = Gl;

TEST_F(Patterns, FilteredIsTheMasksCoverage) {
    const Mask mask = starMask();
    for (const bool compressed : {false, true}) {
        Pattern pattern(mask, {compressed, true, false});
        for (const double periods : {0.3, 1.0, 2.5}) {
            const asset::View view = viewOf(periods, 0.3);
            const image::Raster drawn = pattern.render(view);
            for (int y = 0; y < 64; ++y)
                for (int x = 0; x < 64; ++x) {
                    const Looked at = lookedAt(mask, view, x, y);
                    Cost cost;
                    EXPECT_NEAR(drawn.pixel(x, y)[0], maskCoverage(mask, at.point, at.pixel, cost), 2.0 / 255)
                        << periods << " at " << x << ", " << y;
                }
        }
    }
}

TEST_F(Patterns, UnfilteredIsWhatTheCentreIs) {
    const Mask mask = starMask();
    for (const bool compressed : {false, true}) {
        Pattern pattern(mask, {compressed, false, false});
        for (const double periods : {0.3, 1.0, 20.0}) {
            const asset::View view = viewOf(periods, 1.1);
            const image::Raster drawn = pattern.render(view);
            int wrong = 0, inside = 0;
            for (int y = 0; y < 64; ++y)
                for (int x = 0; x < 64; ++x) {
                    const bool expected = classify(mask, lookedAt(mask, view, x, y).point);
                    wrong += (drawn.pixel(x, y)[0] > 0.5f) != expected;
                    inside += expected;
                }
            EXPECT_LE(wrong, 2) << periods;  // single precision beside an edge
            EXPECT_GT(inside, 20);
            EXPECT_LT(inside, 4076);
        }
    }
}

TEST_F(Patterns, FarAwayIsTheMean) {
    const Mask mask = starMask();
    Pattern pattern(mask, {});
    const image::Raster drawn = pattern.render(viewOf(2000, 0.2));
    for (int i = 0; i < 64 * 64; i += 97)
        EXPECT_NEAR(drawn.rgba[std::size_t(i) * 4], mask.mip.texels.back() / 255.0, 2.0 / 255);
}

TEST_F(Patterns, CompressionSavesBytes) {
    const Mask mask = starMask();
    EXPECT_LT(Pattern(mask, {true, true, false}).bytes() * 4, Pattern(mask, {false, true, false}).bytes());
}

}  // namespace
}  // namespace vtm::paper
