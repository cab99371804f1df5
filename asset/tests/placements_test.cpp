// Placements changed in an asset, against a picture compiled anew.
#include <vtm/asset/placements.hpp>

#include <cmath>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

#include <glm/mat2x2.hpp>

#include <vtm/asset/container.hpp>
#include <vtm/compiler/compile.hpp>
#include <vtm/raster/evaluate.hpp>
#include <vtm/raster/scan.hpp>
#include <vtm/svg/load.hpp>
#include "asset/testing.hpp"

namespace vtm::asset::test {
namespace {

Asset compiled(const std::string& content, double width, double height, bool instances = false) {
    const std::string svg = "<svg xmlns='http://www.w3.org/2000/svg' width='" + std::to_string(width) +
                            "' height='" + std::to_string(height) + "'>" + content + "</svg>";
    compiler::Options options;
    options.instances = instances;
    return compiler::compile(svg::load(std::vector<std::uint8_t>(svg.begin(), svg.end())).scene, options)
        .asset;
}

const std::string star =
    "<path d='M10 1 L12 8 L19 8 L13 12 L16 19 L10 15 L4 19 L7 12 L1 8 L8 8z' fill='gold'/>"
    "<circle cx='10' cy='10' r='2' fill='navy'/>";
const std::string sky = "<rect width='400' height='300' fill='#204060'/>";

double worst(const image::Raster& a, const image::Raster& b) {
    double difference = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i)
        difference = std::max(difference, 255 * double(std::abs(a.rgba[i] - b.rgba[i])));
    return difference;
}

/// Stars at random angles and sizes, one in each square of 50 × 50.
struct Stars {
    std::vector<Placement> placements;
    std::string svg = sky;
};

Stars randomStars(const Placement& one, std::uint16_t ground, unsigned seed) {
    Stars stars;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int i = 0; i < 48; ++i) {
        const double scale = 0.4 + 1.2 * unit(random), angle = 6.28 * unit(random);
        const double c = scale * std::cos(angle), s = scale * std::sin(angle);
        const glm::dvec2 middle(25 + 50 * (i % 8), 25 + 50 * (i / 8));
        const glm::dmat2 linear(c, s, -s, c);
        const glm::dvec2 offset = middle - linear * glm::dvec2(10);
        Placement placement = one;
        placement.paints[0] = ground;
        placement.toPicture = glm::dmat3x2(linear * one.toPicture[0], linear * one.toPicture[1],
                                           linear * one.toPicture[2] + offset);
        stars.placements.push_back(placement);
        stars.svg += "<g transform='matrix(" + std::to_string(c) + " " + std::to_string(s) + " " +
                     std::to_string(-s) + " " + std::to_string(c) + " " + std::to_string(offset.x) + " " +
                     std::to_string(offset.y) + ")'>" + star + "</g>";
    }
    return stars;
}

View wholeView(const Asset& asset, int pixels) {
    const double scale = pixels / asset.width;
    View view{pixels, int(asset.height * scale), {}};
    view.toPixels = {scale, 0, 0, scale, 0, 0};
    return view;
}

TEST(Placements, ShowThePictureThatTheyDescribe) {
    Asset asset = compiled(sky, 400, 300);
    ASSERT_EQ(asset.paints.size(), 2u);
    const Placement one = addPicture(asset, compiled(star, 20, 20));
    EXPECT_EQ(one.paints.size(), 3u);
    for (unsigned seed = 0; seed < 8; ++seed) {
        const Stars stars = randomStars(one, 1, seed);
        const Asset placed = read(write(withPlacements(asset, stars.placements)));
        EXPECT_EQ(placed.instances.size(), 48u);
        const Asset flat = compiled(stars.svg, 400, 300);
        for (const int pixels : {100, 400, 1500}) {
            const View view = wholeView(asset, pixels);
            // Both may be off by what a 65536th of their own longer side is in pixels.
            EXPECT_LE(worst(Scanner(placed).draw(view), Scanner(flat).draw(view)), pixels > 1000 ? 4 : 2)
                << seed << " " << pixels;
        }
    }
}

TEST(Placements, AreReadAsTheyWereWritten) {
    Asset asset = compiled(sky, 400, 300);
    const Placement one = addPicture(asset, compiled(star, 20, 20));
    const Stars stars = randomStars(one, 1, 3);
    const Asset placed = withPlacements(asset, stars.placements);
    const std::vector<Placement> read = placementsOf(placed);
    ASSERT_EQ(read.size(), stars.placements.size());
    const Asset again = withPlacements(placed, read);
    const View view = wholeView(asset, 400);
    EXPECT_LE(worst(Scanner(placed).draw(view), Scanner(again).draw(view)), 0.5);
    EXPECT_EQ(again.symbols.size(), placed.symbols.size());  // those of before do not pile up
    EXPECT_EQ(again.nodes.size(), placed.nodes.size());
    EXPECT_TRUE(withPlacements(placed, {}).instances.empty());
    EXPECT_EQ(write(withPlacements(placed, {})).size(), write(withPlacements(asset, {})).size());
}

TEST(Placements, OfACompiledPictureCanBeChanged) {
    std::string svg = sky;
    for (int i = 0; i < 40; ++i)
        svg += "<g transform='translate(" + std::to_string(5 + 48 * (i % 8)) + " " +
               std::to_string(5 + 58 * (i / 8)) + ")'>" + star + "</g>";
    const Asset asset = compiled(svg, 400, 300, true);
    std::vector<Placement> placements = placementsOf(asset);
    ASSERT_EQ(placements.size(), 40u);
    const View view = wholeView(asset, 800);
    EXPECT_LE(worst(Scanner(withPlacements(asset, placements)).draw(view), Scanner(asset).draw(view)), 0.5);
    // Half of them go; others change colours.
    placements.resize(20);
    for (Placement& placement : placements)
        std::swap(placement.paints[1], placement.paints.back());
    const Asset changed = read(write(withPlacements(asset, placements)));
    EXPECT_EQ(changed.instances.size(), 20u);
    EXPECT_GT(worst(Scanner(changed).draw(view), Scanner(asset).draw(view)), 100);
    EXPECT_LE(worst(Scanner(changed).draw(view), evaluate(changed, view)), 1);
}

/// Maps in maps stay as they are.
TEST(Placements, LeaveInnerMapsAlone) {
    const Asset asset = placedMaps();
    const std::vector<Placement> placements = placementsOf(asset);
    ASSERT_EQ(placements.size(), 2u);
    const View view = wholeView(asset, 64);
    const Asset again = read(write(withPlacements(asset, placements)));
    EXPECT_LE(worst(Scanner(again).draw(view), Scanner(asset).draw(view)), 0.5);
    const Asset one = read(write(withPlacements(asset, std::span(placements).first(1))));
    EXPECT_EQ(one.instances.size(), 2u);  // and the one inside
}

/// Errors of boundaries grow with the placement, and so does the finest pixel.
TEST(Placements, EnlargedOnesAreLessFine) {
    Asset asset = compiled(sky, 400, 300);
    Placement one = addPicture(asset, compiled(star, 20, 20));
    one.paints[0] = 1;
    const double fine = *withPlacements(asset, std::vector{one}).finestPixel;
    EXPECT_EQ(fine, *asset.finestPixel);
    one.toPicture *= 5;
    const Asset large = withPlacements(asset, std::vector{one});
    EXPECT_NEAR(*large.finestPixel, 5 * fine, 1e-6 * fine);
    EXPECT_NEAR(*withPlacements(large, std::vector{one}).finestPixel, 5 * fine, 1e-3 * fine);
}

TEST(Placements, BeyondThePictureAreLeftOut) {
    Asset asset = compiled(sky, 400, 300);
    Placement one = addPicture(asset, compiled(star, 20, 20));
    one.paints[0] = 1;
    const auto at = [&](double x, double y) {
        Placement moved = one;
        moved.toPicture[2] += glm::dvec2(x, y);
        return moved;
    };
    EXPECT_EQ(withPlacements(asset, std::vector{at(-50, 0), at(100, 100), at(0, 900)}).instances.size(), 1u);
    EXPECT_THROW(withPlacements(asset, std::vector{at(395, 100)}),
                 std::invalid_argument);  // half of it is seen
}

TEST(Placements, AreRefusedByName) {
    Asset asset = compiled(sky, 400, 300);
    const Placement one = addPicture(asset, compiled(star, 20, 20));
    const auto refusal = [&](const auto& change) -> std::string {
        std::vector<Placement> placements(2, one);
        change(placements[1]);
        try {
            withPlacements(asset, placements);
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(refusal([](Placement&) {}), "");
    EXPECT_EQ(refusal([](Placement& p) { p.map = 0; }),
              "placements[1]: refers to a map that cannot be placed");
    EXPECT_EQ(refusal([](Placement& p) { p.map = 7; }),
              "placements[1]: refers to a map that cannot be placed");
    EXPECT_EQ(refusal([](Placement& p) { p.paints.pop_back(); }),
              "placements[1]: has not one paint for each number of its map");
    EXPECT_EQ(refusal([](Placement& p) { p.paints[1] = 99; }), "placements[1]: refers to a missing paint");
    EXPECT_EQ(refusal([](Placement& p) { p.toPicture[0] = p.toPicture[1]; }),
              "placements[1]: its matrix is singular");
    EXPECT_EQ(refusal([](Placement& p) { p.toPicture[2].x = std::nan(""); }),
              "placements[1]: its matrix is not finite");
    EXPECT_EQ(refusal([](Placement& p) { p.toPicture[2].x = -12; }),
              "placements[1]: its middle lies outside the picture's square");
    // Regular, but a line once it is stored.
    EXPECT_NE(refusal([](Placement& p) { p.toPicture[0] = p.toPicture[1] + glm::dvec2(0, 1e-6); }), "");
    EXPECT_THROW(placementsOf(layers()), std::invalid_argument);
    EXPECT_THROW(addPicture(asset, everyPaint()), std::invalid_argument);
    EXPECT_THROW(addPicture(asset, placedMaps()), std::invalid_argument);
}

}  // namespace
}  // namespace vtm::asset::test
