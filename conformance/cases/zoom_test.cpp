// 4096 times as large as on 1024 pixels: outlines are where they should be, to a quarter of a pixel, and the
// squares of the tree do not show.

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <fmt/core.h>

#include <vtm/compiler/compile.hpp>
#include <vtm/raster/evaluate.hpp>
#include "conformance/cases/certify.hpp"
#include "conformance/cases/distances.hpp"
#include "conformance/cases/support.hpp"
#include "conformance/compare/compare.hpp"

namespace vtm::cases {
namespace {

using scene::Point;

constexpr double picturePixels = 1024, zoom = 4096;
constexpr double farthest = 0.25;  ///< pixels that an outline may be off

std::vector<std::filesystem::path> files() {
    return {sharedDirectory() / "corpus/tiger.svg", examplesDirectory() / "planet.svg"};
}

/// A picture that is fine enough, and places to look at.
struct Zoomed {
    scene::Scene scene;
    double side, pixel;  ///< longer side; a pixel at that zoom, in the picture's units
    compiler::Result result;
    Outlines outlines;

    explicit Zoomed(const std::filesystem::path& file)
        : scene(loadScene(file)),
          side(std::max(scene.width, scene.height)),
          pixel(side / (picturePixels * zoom)),
          result(compiler::compile(scene, {.tolerance = farthest * pixel / side})),
          outlines(scene) {}

    Window window(Point centre, double angle, int pixels) const {
        return {centre, pixel, pixels, farthest * pixel, angle};
    }

    /// On and beside outlines, and where drawn outlines pass from one square of the tree to the next; turned
    /// in one case of two.
    std::vector<Window> windows(int count, int pixels, std::uint64_t seed) const {
        std::mt19937_64 random(seed);
        const auto share = [&] { return std::ldexp(double(random() >> 11), -53); };
        const DrawnBoundary drawn(result.asset);
        std::vector<OutlinePoint> known;
        for (std::uint64_t s = seed; known.size() < std::size_t(count); ++s) {
            const auto more = outlines.pointsOn(s, count);
            known.insert(known.end(), more.begin(), more.end());
        }
        std::vector<Window> chosen;
        while (chosen.size() < std::size_t(count)) {
            const bool crossing = random() % 3 == 0;
            Point p = crossing ? drawn.crossings()[random() % drawn.crossings().size()]
                               : known[random() % known.size()].at;
            p += pixel * pixels * (Point(share(), share()) - 0.5);
            if (p.x > 0 && p.y > 0 && p.x < scene.width && p.y < scene.height)
                chosen.push_back(window(p, random() % 2 == 0 ? 0 : 6.283185307179586 * share(), pixels));
        }
        return chosen;
    }
};

image::Raster draw(const asset::Asset& asset, const Window& window) {
    return asset::evaluate(asset, {window.pixels, window.pixels, toPixels(window)});
}

/// What a view shows.
struct Seen {
    int edges = 0, flats = 0;  ///< pixels with an outline near, and without
    double worst = 0;          ///< largest error in a channel, 0 to 1
    std::string wrong;         ///< the first pixel that is beyond its bound
};

/// A pixel's error is at most the share of it that lies within a quarter of a pixel of an outline, as the
/// rest has its true colour: nothing at all where no outline is near. `parts` a side show that share.
Seen look(const Zoomed& zoomed, const asset::Asset& asset, const Window& window) {
    constexpr int parts = 8;
    constexpr double flatness = 1.0 / 256;
    const int n = window.pixels;
    const std::vector<double> near = zoomed.outlines.nearShares(window, parts);
    const image::Raster truth =
        reference::render(zoomed.scene, {n, n, toPixels(window)}, {.flatness = flatness});
    const image::Raster drawn = draw(asset, window);
    Seen seen;
    for (int y = 1; y < n - 1; ++y)
        for (int x = 1; x < n - 1; ++x) {
            const double share = near[std::size_t(y * n + x)];
            (share > 0 ? seen.edges : seen.flats) += 1;
            for (int c = 0; c < 4; ++c) {
                const double error = std::abs(double(truth.pixel(x, y)[c]) - double(drawn.pixel(x, y)[c]));
                seen.worst = std::max(seen.worst, error);
                if (!(error <= share + colourBound) && seen.wrong.empty())
                    seen.wrong =
                        fmt::format("pixel {}, {} of the view at {}, {}: channel {} is off by {}, not {}", x,
                                    y, window.centre.x, window.centre.y, c, error, share);
            }
        }
    return seen;
}

class Zoom : public testing::TestWithParam<std::filesystem::path> {
protected:
    void SetUp() override {
        if (!std::filesystem::exists(GetParam()))
            GTEST_SKIP() << GetParam() << " is absent";
    }
};

std::string nameOf(const testing::TestParamInfo<std::filesystem::path>& info) {
    return info.param.stem().string();
}

INSTANTIATE_TEST_SUITE_P(File, Zoom, testing::ValuesIn(files()), nameOf);

TEST_P(Zoom, KeepsOutlinesWithinAQuarterOfAPixel) {
    const Zoomed zoomed(GetParam());
    EXPECT_LE(zoomed.result.provenError * picturePixels * zoom, farthest);
    EXPECT_TRUE(zoomed.result.unproven.empty());
    constexpr int views = 1000, pixels = 16;
    Seen all;
    for (const Window& window : zoomed.windows(views, pixels, 1)) {
        const Seen seen = look(zoomed, zoomed.result.asset, window);
        EXPECT_EQ(seen.wrong, "");
        all.edges += seen.edges, all.flats += seen.flats, all.worst = std::max(all.worst, seen.worst);
    }
    EXPECT_GE(all.edges, 4 * views);  // the views show outlines
    EXPECT_GE(all.flats, 4 * views);
    RecordProperty("largest_error_255ths", std::to_string(255 * all.worst));
    RecordProperty("edge_pixels", all.edges);
    RecordProperty("flat_pixels", all.flats);
}

/// The same without pixels.
TEST_P(Zoom, KeepsDrawnBoundariesNearTrueOutlines) {
    const Zoomed zoomed(GetParam());
    constexpr int drawn = 1000, truths = 150;
    const Distances found =
        measure(zoomed.scene, zoomed.result.asset, farthest * zoomed.pixel, 1, drawn, truths);
    EXPECT_LE(found.fromDrawn, 1);
    EXPECT_LE(found.fromTrue, 1);
    EXPECT_EQ(found.drawn, drawn);
    EXPECT_GE(found.truths, truths / 5);
    RecordProperty("from_drawn_pixels", std::to_string(farthest * found.fromDrawn));
    RecordProperty("from_true_pixels", std::to_string(farthest * found.fromTrue));
}

/// The test sees what it should: a picture that is moved by a pixel in each axis.
TEST_P(Zoom, SeesOutlinesThatAreFartherOff) {
    const Zoomed zoomed(GetParam());
    asset::Asset moved = zoomed.result.asset;
    moved.maps[0].x += zoomed.pixel, moved.maps[0].y += zoomed.pixel;
    int seen = 0;
    constexpr int views = 20;
    for (const Window& window : zoomed.windows(views, 16, 1))
        seen += !look(zoomed, moved, window).wrong.empty();
    EXPECT_GE(seen, views / 3);
}

TEST_P(Zoom, IsDrawnAlikeByTheGpu) {
    const Zoomed zoomed(GetParam());
    Gl gl;
    const auto uploaded = gl.renderer.upload(zoomed.result.asset);
    constexpr int views = 24, pixels = 256;
    constexpr double maximum = 2;  // 255ths
    double worst = 0;
    for (const Window& window : zoomed.windows(views, pixels, 2)) {
        const image::Raster drawn = gl.renderer.render(uploaded, {pixels, pixels, toPixels(window)});
        const compare::Difference d = compare::compare(drawn, draw(zoomed.result.asset, window));
        EXPECT_LE(d.max, maximum) << "at " << d.worstX << ", " << d.worstY << " of the view at "
                                  << window.centre.x << ", " << window.centre.y;
        worst = std::max(worst, d.max);
    }
    RecordProperty("largest_difference_255ths", std::to_string(worst));
}

}  // namespace
}  // namespace vtm::cases
