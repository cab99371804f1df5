// Pictures sampled as textures (docs/texture.md): against the truth, against the same picture drawn exactly,
// under perspective, while turning and while zooming.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include <gtest/gtest.h>

#include <fmt/core.h>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <vtm/compiler/compile.hpp>
#include <vtm/raster/evaluate.hpp>
#include "backend_gl/testing.hpp"
#include "conformance/cases/support.hpp"
#include "conformance/cases/texture_views.hpp"
#include "conformance/compare/compare.hpp"
#include "conformance/reference/reference.hpp"

namespace vtm::cases {

std::ostream& operator<<(std::ostream& out, const CorpusFile& file) { return out << file.name; }

namespace {

namespace fs = std::filesystem;
using compare::Difference;
using glm::dvec2;
using image::Raster;

/// In 1/255. `twin`: of texture and picture, where nothing is minified.
constexpr double twinMax = 2, exactMax = 4, exactRms = 0.3, minifiedRms = 2;
/// Paints that vary are looked at once a footprint and leaf.
constexpr double variedRms = 0.5;

// ---- The corpus ---------------------------------------------------------------------------------------

class CorpusTexture : public testing::TestWithParam<CorpusFile> {
protected:
    void SetUp() override {
        if (!fs::exists(sharedDirectory() / "corpus"))
            GTEST_SKIP() << sharedDirectory() / "corpus"
                         << " is absent";
    }
};

INSTANTIATE_TEST_SUITE_P(File, CorpusTexture, testing::ValuesIn(corpusFiles()),
                         [](const auto& tested) { return tested.param.name; });

TEST_P(CorpusTexture, MatchesTheTruth) {
    const CorpusFile& file = GetParam();
    if (file.limits.empty())
        GTEST_SKIP() << file.name << " has no truth";
    Gl gl;
    const Measurement measured(file.name);
    gl::test::TextureCanvas texture(measured.asset());
    bool matches = true;
    for (const CorpusFile::Limit& limit : file.limits) {
        const Raster drawn = texture.draw(wholePicture(measured.scene(), limit.size));
        const Difference d = compare::compare(asWritten(drawn), truthOf(file.name, limit.size));
        const double maximum = limit.size == 1024 ? 3 * limit.floor : limit.best / 3;
        EXPECT_TRUE(d.mean <= maximum || !file.expectedFailure.empty())
            << file.name << " at " << limit.size << " px: mean " << d.mean << " (at most " << maximum << ')';
        matches = matches && d.mean <= maximum;
        RecordProperty(fmt::format("mean_{}", limit.size), fmt::format("{:.4f} of {:.4f}", d.mean, maximum));
    }
    EXPECT_EQ(matches, file.expectedFailure.empty()) << file.name << ": " << file.expectedFailure;
}

TEST_P(CorpusTexture, IsThePictureAtAnySize) {
    Gl gl;
    const Measurement measured(GetParam().name);
    gl::test::TextureCanvas texture(measured.asset());
    double worst = 0;
    for (const int size : {1024, 512, 256, 128, 64, 32}) {
        const asset::View view = wholePicture(measured.scene(), size);
        const bool large = size >= 512, flat = !hasPrograms(measured.asset());
        const Difference d =
            compare::compare(texture.draw(view), large ? asset::evaluate(measured.asset(), view)
                                                       : exactMeans(measured.asset(), view));
        worst = std::max(worst, d.rms);
        if (size == 1024 && flat) {
            EXPECT_LE(d.max, twinMax) << "at " << d.worstX << ", " << d.worstY;
        }
        RecordProperty(fmt::format("rms_{}", size), fmt::format("{:.3f}", d.rms));
    }
    EXPECT_LE(worst, minifiedRms);
}

// ---- Any picture --------------------------------------------------------------------------------------

/// A drawing of ours, or a file of the corpus.
class Texture : public testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        const fs::path own = examplesDirectory() / (std::string(GetParam()) + ".svg"),
                       real = sharedDirectory() / "corpus" / (std::string(GetParam()) + ".svg");
        if (!fs::exists(own) && !fs::exists(real))
            GTEST_SKIP() << real << " is absent";
        scene = loadScene(fs::exists(own) ? own : real);
        asset = compiler::compile(scene).asset;
        gl = std::make_unique<Gl>();
        texture = std::make_unique<gl::test::TextureCanvas>(asset);
    }
    void TearDown() override {
        texture.reset();
        gl.reset();
    }

    dvec2 size() const { return {scene.width, scene.height}; }
    Raster exact(const asset::View& view) const { return exactMeans(asset, view); }

    scene::Scene scene;
    asset::Asset asset;
    std::unique_ptr<Gl> gl;
    std::unique_ptr<gl::test::TextureCanvas> texture;
};

INSTANTIATE_TEST_SUITE_P(Of, Texture,
                         testing::Values("lighthouse", "rose_window", "planet", "tiger", "world", "counties"),
                         [](const auto& tested) { return std::string(tested.param); });

TEST_P(Texture, MatchesTheReferenceWhereNothingIsMinified) {
    const asset::View view = wholePicture(scene, 1024);
    const Difference d = compare::compare(texture->draw(view),
                                          reference::render(scene, {view.width, view.height, view.toPixels}));
    EXPECT_LE(d.max, exactMax) << "at " << d.worstX << ", " << d.worstY;
    EXPECT_LE(d.rms, exactRms);
}

TEST_P(Texture, StaysRightWhileItTurns) {
    const int step = std::string_view(GetParam()) == "tiger" ? 1 : 7;
    for (int degrees = 0; degrees < 360; degrees += step) {
        const asset::View view = turned(size(), 96, 128, degrees * std::numbers::pi / 180);
        const Difference d = compare::compare(texture->draw(view), exact(view));
        ASSERT_LE(d.rms, hasPrograms(asset) ? variedRms : exactRms) << degrees;
        ASSERT_TRUE(d.max <= exactMax || hasPrograms(asset)) << degrees << ": " << d.max;
    }
}

/// Footprints of one shape: an affine view, which the evaluator draws exactly.
TEST_P(Texture, StretchedFootprintsAreExactEnough) {
    for (const auto& [ratio, maximum] : {std::pair{4.0, 1.0}, {16.0, 3.0}})
        for (const int pixels : {1024, 256, 64})
            for (int i = 0; i < 4; ++i) {
                const asset::View view = stretched(size(), 160, pixels, ratio, 0.1 + 0.9 * i, 0.4 * i);
                EXPECT_LE(compare::compare(texture->draw(view), exact(view)).rms, maximum)
                    << ratio << " : 1, " << pixels << " px, " << i;
            }
}

/// A floor of copies up to the horizon, footprints up to 1 : 4 or 1 : 16, against 8 × 8 samples each.
TEST_P(Texture, PerspectiveIsExactEnough) {
    for (const auto& [floor, maximum] : {std::pair{mildFloor, 1.0}, {steepFloor, 3.0}}) {
        const gl::Wrapping repeated{asset::Wrap::Repeat, asset::Wrap::Repeat};
        constexpr int samples = 8;
        const Raster drawn = texture->draw(floor.toPicture(1), floor.width, floor.height, repeated);
        const Raster fine =
            texture->draw(floor.toPicture(samples), floor.width * samples, floor.height * samples, repeated);
        EXPECT_LE(compare::compare(drawn, averaged(fine, samples)).rms, maximum) << floor.ratio;
    }
}

/// From 16 to 65536 pixels: what changes from frame to frame beyond what the exact picture changes.
TEST_P(Texture, ZoomsWithoutAJump) {
    const std::vector<ZoomFrame> frames = zoomed(
        size(), [&](const asset::View& view) { return texture->draw(view); },
        [&](const asset::View& view) { return exact(view); });
    ASSERT_EQ(frames.size(), 97u);
    EXPECT_GT(frames.back().contrast, 0.1);  // there is something to see
    for (const ZoomFrame& frame : frames) {
        EXPECT_LE(frame.change, 2) << frame.pixels << " px";
        EXPECT_LE(frame.error, 2) << frame.pixels << " px";
    }
}

// ---- Below the horizon --------------------------------------------------------------------------------

/// The mean of an opaque picture over a pixel of a floor of copies, by a lattice of points in it.
glm::dvec3 meanOnFloor(const Raster& picture, const glm::dmat3& toPicture, int x, int y) {
    constexpr int samples = 24;
    glm::dvec3 sum(0);
    for (int i = 0; i < samples * samples; ++i) {
        const glm::dvec3 p =
            toPicture * glm::dvec3(x + (i % samples + 0.5) / samples, y + (i / samples + 0.5) / samples, 1);
        const dvec2 st = dvec2(p) / p.z, place = (st - glm::floor(st)) * dvec2(picture.width, picture.height);
        const float* pixel = picture.pixel(std::min(int(place.x), picture.width - 1),
                                           std::min(int(place.y), picture.height - 1));
        sum += glm::dvec3(pixel[0], pixel[1], pixel[2]);
    }
    return sum / double(samples * samples);
}

/// Copies of an opaque picture up to four pixels below the horizon, where a pixel meets so many squares,
/// strips and copies that loops have to be counted: nothing shines through.
TEST(FloorOfTheLighthouse, IsOpaqueUpToTheHorizon) {
    const scene::Scene scene = loadScene(examplesDirectory() / "lighthouse.svg");
    const asset::Asset asset = compiler::compile(scene).asset;
    const Gl gl;
    gl::test::TextureCanvas texture(asset);
    const Raster picture = asset::evaluate(asset, wholePicture(scene, 1024));
    constexpr double blurred = 16;  // longer footprints are widened
    for (const Floor& floor : {Floor{192, 64, 40, 4}, Floor{192, 64, 16, 8}, Floor{192, 64, 120, 1.5}}) {
        const glm::dmat3 toPicture = floor.toPicture(1);
        const Raster drawn =
            texture.draw(toPicture, floor.width, floor.height, {asset::Wrap::Repeat, asset::Wrap::Repeat});
        double squares = 0, count = 0;
        for (int y = 0; y < floor.height; ++y)
            for (int x = 0; x < floor.width; ++x) {
                const float* pixel = drawn.pixel(x, y);
                ASSERT_GE(pixel[3], 254.5f / 255) << floor.ratio << ": " << x << ", " << y;
                if (floor.ratio * floor.horizon > blurred * (floor.horizon + y) || x % 4 != 0)
                    continue;
                const glm::dvec3 off =
                    glm::dvec3(pixel[0], pixel[1], pixel[2]) - meanOnFloor(picture, toPicture, x, y);
                squares += glm::dot(off, off) / 3;
                ++count;
            }
        EXPECT_LE(255 * std::sqrt(squares / count), 3) << floor.ratio;
    }
}

}  // namespace
}  // namespace vtm::cases
