// Pictures that are drawn once, from the scene itself, against those that are drawn from the compiled asset:
// random scenes, hard ones and real files; whole, turned, small and magnified.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include <gtest/gtest.h>

#include <fmt/core.h>

#include <vtm/compiler/draw_view.hpp>
#include <vtm/raster/scan.hpp>
#include "conformance/cases/support.hpp"
#include "conformance/compare/compare.hpp"
#include "conformance/generate/generate.hpp"

namespace vtm::cases {
namespace {

/// Both are within half of it of the true picture, but where outlines run within a pixel's 64th of each
/// other.
constexpr double mostApart = 2, rmsApart = 0.3;

struct Looked {
    const char* name;
    int pixels;   ///< of the picture's longer side
    double turn;  ///< radians
    double zoom;  ///< about the middle
};
constexpr Looked views[]{
    {"whole", 200, 0, 1}, {"turned", 150, 0.7, 1}, {"small", 16, 0.2, 1}, {"near", 120, 2.5, 9}};

asset::View viewOf(const scene::Scene& scene, const Looked& looked) {
    const double scale = looked.pixels / std::max(scene.width, scene.height);
    const int width = std::max(1, int(scale * scene.width + 0.5)),
              height = std::max(1, int(scale * scene.height + 0.5));
    const double c = scale * looked.zoom * std::cos(looked.turn),
                 s = scale * looked.zoom * std::sin(looked.turn);
    const scene::Point middle = 0.5 * scene::Point(scene.width, scene.height);
    const scene::Point at{c * middle.x - s * middle.y, s * middle.x + c * middle.y};
    return {width, height, {c, s, -s, c, 0.5 * width - at.x, 0.5 * height - at.y}};
}

/// Scenes that are compiled in any case, and those whose compiled picture is not proven, say nothing.
void compareDrawings(const scene::Scene& scene, const std::string& name) {
    const compiler::Result compiled = compiler::compile(scene);
    if (!compiled.unproven.empty() || compiled.asset.fallbackLeaves > 0 ||
        !asset::isSumOfMaps(compiled.asset))
        return;
    const asset::Scanner scanner(compiled.asset);
    for (const Looked& looked : views) {
        const asset::View view = viewOf(scene, looked);
        const auto drawing = compiler::ViewDrawing::make(scene, view);
        if (!drawing)
            return;
        const compare::Difference d = compare::compare(drawing->draw(), scanner.draw(view));
        EXPECT_LE(d.max, mostApart) << name << ", " << looked.name << " at " << d.worstX << ", " << d.worstY;
        EXPECT_LE(d.rms, rmsApart) << name << ", " << looked.name;
    }
}

TEST(DrawnOnce, RandomScenesLookAsCompiledOnes) {
    for (std::uint64_t seed = 0; seed < 150; ++seed)
        compareDrawings(generate::randomScene(seed), fmt::format("seed {}", seed));
}

TEST(DrawnOnce, HardScenesLookAsCompiledOnes) {
    for (const generate::Family& family : generate::hardFamilies())
        for (std::uint64_t seed = 0; seed < 6; ++seed)
            compareDrawings(family.make(seed), fmt::format("{} {}", family.name, seed));
}

TEST(DrawnOnce, FilesLookAsCompiledOnes) {
    int files = 0;
    for (const std::filesystem::path& folder : {sharedDirectory() / "corpus", examplesDirectory()}) {
        std::error_code none;
        for (const auto& entry : std::filesystem::directory_iterator(folder, none))
            if (entry.path().extension() == ".svg" && ++files > 0)
                compareDrawings(loadScene(entry.path()), entry.path().filename());
    }
    EXPECT_GT(files, 0);
}

std::vector<std::uint8_t> bytesOf(const compiler::ViewDrawing& drawing) {
    std::vector<std::uint8_t> bytes(std::size_t(drawing.width()) * std::size_t(drawing.height()) * 4);
    drawing.draw({bytes.data(), std::size_t(drawing.width()) * 4});
    return bytes;
}

/// Threads share the strips out among them.
TEST(DrawnOnce, StripsDoNotDependOnEachOther) {
    const scene::Scene scene = loadScene(examplesDirectory() / "planet.svg");
    const auto drawing = compiler::ViewDrawing::make(scene, wholePicture(scene, 900));
    ASSERT_TRUE(drawing);
    const image::Raster all = drawing->draw();
    for (int first = 0, rows = 1; first < drawing->height(); first += rows, rows += 60)
        drawing->scan(first, std::min(first + rows, drawing->height()),
                      [&](int y, const asset::ColorRun& run) {
                          for (int x = run.first; x < run.end; ++x)
                              for (int c = 0; c < 4; ++c)
                                  ASSERT_EQ(all.pixel(x, y)[c], std::clamp(run.color[c], 0.0f, 1.0f));
                      });
}

TEST(DrawnOnce, ViewsThatShowNothingAreTransparent) {
    const scene::Scene scene = generate::randomScene(1);
    for (const asset::View& view :
         {asset::View{7, 5, {0, 0, 0, 0, 0, 0}}, asset::View{7, 5, {1, 0, 0, 1, 1e6, 0}}}) {
        const auto drawing = compiler::ViewDrawing::make(scene, view);
        ASSERT_TRUE(drawing);
        EXPECT_EQ(bytesOf(*drawing), std::vector<std::uint8_t>(7 * 5 * 4));
    }
}

}  // namespace
}  // namespace vtm::cases
