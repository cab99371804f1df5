// Maps that are placed many times, scanned: letters whose chords are made once, and those that need their
// own.

#include <vtm/raster/scan.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <vtm/compiler/compile.hpp>
#include <vtm/raster/evaluate.hpp>
#include <vtm/svg/load.hpp>
#include "raster/testing_views.hpp"

namespace vtm::asset::test {
namespace {

/// Three hundred letters of two shapes in two colours: most upright, some turned, mirrored or larger, two
/// that abut.
Asset letters() {
    std::string svg =
        R"(<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="64" height="64">
           <defs><path id="a" d="M0 2C0 0 2 0 2 1V2H1.6V1C1.6.6.4.6.4 2z"/>
           <path id="b" d="M0 0H1C2 0 2 1 1.4 1C2.2 1 2.2 2 1 2H0zM.4.4V.8H1V.4z" fill-rule="evenodd"/></defs>)";
    std::mt19937 random(11);
    for (int i = 0; i < 300; ++i) {
        const double x = 3.2 * (i % 20), y = 4.2 * (i / 20);
        std::string how = fmt::format("translate({} {})", x, y);
        if (i % 7 == 3)
            how += fmt::format("rotate({} 1 1)", random() % 360);
        else if (i % 11 == 5)
            how += "translate(2 0)scale(-1 1)";
        else if (i % 13 == 6)
            how += "scale(1.2)";
        svg += fmt::format(R"(<use xlink:href="#{}" transform="{}" fill="{}"/>)", i % 3 == 0 ? 'a' : 'b', how,
                           i % 5 == 0 ? "#c22" : "#124");
    }
    svg += "</svg>";
    return compiler::compile(svg::load({reinterpret_cast<const std::uint8_t*>(svg.data()), svg.size()}).scene)
        .asset;
}

std::vector<std::uint8_t> bytesOf(const Scanner& scanner, const View& view) {
    std::vector<std::uint8_t> bytes(std::size_t(view.width) * std::size_t(view.height) * 4);
    scanner.draw(view, {bytes.data(), std::size_t(view.width) * 4});
    return bytes;
}

TEST(PlacedMaps, AreScannedAsTheyAreEvaluated) {
    const Asset asset = letters();
    ASSERT_GT(asset.instances.size(), 200u);
    const Scanner scanner(asset);
    std::mt19937 random(3);
    for (int i = 0; i < 40; ++i) {
        const View view = randomView(random, 90, 70);
        const image::Raster scanned = scanner.draw(view), evaluated = evaluate(asset, view);
        double worst = 0;
        for (std::size_t k = 0; k < scanned.rgba.size(); ++k)
            worst = std::max(worst, std::abs(double(scanned.rgba[k]) - double(evaluated.rgba[k])));
        // As of any curves (docs/coverage.md); text far below a pixel 2/255.
        ASSERT_LE(worst, 2.0 / 255) << "view " << i;
    }
}

/// What is kept from one view must not be seen in the next, which moves, turns or cuts the letters.
TEST(PlacedMaps, ViewsInTurnAreThoseOfNewScanners) {
    const Asset asset = letters();
    const Scanner scanner(asset);
    std::mt19937 random(5);
    std::vector<View> views{
        turnedView(300, 200, {30, 30}, 3, 0),   turnedView(300, 200, {31.3, 30.2}, 3, 0),
        turnedView(300, 200, {30, 30}, 3, 0.1), turnedView(300, 200, {30, 30}, 3, 0, 0, true),
        turnedView(80, 200, {30, 30}, 3, 0),    turnedView(300, 200, {30, 30}, 40, 0)};
    for (int i = 0; i < 10; ++i)
        views.push_back(randomView(random, 120, 90));
    for (int round = 0; round < 2; ++round)
        for (const View& view : views)
            ASSERT_EQ(bytesOf(scanner, view), bytesOf(Scanner(asset), view));
}

TEST(PlacedMaps, OneThreadAndManyGiveTheSameBytes) {
    const Asset asset = letters();
    const View view = turnedView(700, 600, {32, 32}, 9, 0.3);
    const auto bytes = [&](int threads) {
        return tbb::task_arena(threads).execute([&] { return bytesOf(Scanner(asset), view); });
    };
    EXPECT_EQ(bytes(1), bytes(4));
}

}  // namespace
}  // namespace vtm::asset::test
