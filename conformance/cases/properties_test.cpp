// What must hold whatever the scene is: on thousands of random ones, and on real files. A failing random
// scene is reported as the smallest one that fails likewise.
//
// VTM_TEST_ALL takes four times as many, VTM_PROPERTY_SCENES=100000 tries that many scenes in all;
// VTM_PROPERTY_SEED=17 tries that one only.

#include <bit>
#include <cmath>
#include <cstdlib>
#include <random>

#include <gtest/gtest.h>

#include <fmt/core.h>

#include <vtm/asset/container.hpp>
#include <vtm/compiler/compile.hpp>
#include <vtm/raster/evaluate.hpp>
#include "conformance/cases/asset_properties.hpp"
#include "conformance/cases/certify.hpp"
#include "conformance/cases/support.hpp"
#include "conformance/generate/generate.hpp"

namespace vtm::cases {
namespace {

using scene::Scene;

std::uint64_t environmentOr(const char* name, std::uint64_t otherwise) {
    const char* text = std::getenv(name);
    return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

// ---- one scene --------------------------------------------------------------------------------

/// From the finest that is usual to the coarsest that one would want, and all sizes of leaves, by cost and by
/// a fixed rule. (One piece a leaf would send every corner down to the last level.)
compiler::Options optionsOf(std::uint64_t seed) {
    constexpr int bits[] = {16, 16, 12, 10};
    constexpr double byteWorth[] = {400, 400, 400, 10, 20000};
    constexpr unsigned pieces[] = {2, 4, 40};
    std::mt19937_64 random(seed);
    compiler::Options options;
    options.tolerance = std::ldexp(1.0, -bits[random() % 4]);
    options.nanosecondsPerByte = byteWorth[random() % 5];
    if (random() % 4 == 0)
        options.piecesPerLeaf = pieces[random() % 3];
    return options;
}

constexpr int overviewPixels = 32, closeUpPixels = 12, closeUps = 4;
/// Share of the tolerance by which neighbours may place the same crossing of their border differently: both
/// round it.
constexpr double borderSlack = 1.0 / 4;
/// Pixels of the close-ups, in tolerances: a little more than one, since their outlines are flattened.
constexpr double closeUpPixel = 1.0625;
/// Compiling every scene twice would only take longer.
constexpr std::uint64_t repeatedEvery = 8;

std::string borderViolation(const Scene& scene, const Outlines& outlines, const asset::Asset& asset,
                            double tolerance) {
    const double unit = tolerance * std::max(scene.width, scene.height);
    for (const asset::Map& map : asset.maps)
        for (const BorderGap& gap : borderGaps(asset, map, borderSlack * unit))
            for (const double share : {0.1, 0.5, 0.9}) {
                const scene::Point p = gap.from + share * (gap.to - gap.from);
                const bool inside = p.x < scene.width && p.y < scene.height;
                if (inside && !looksEqualAbout(asset, p, unit / 8) &&
                    !outlines.within(p, unit * std::sqrt(0.5), unit))
                    return fmt::format(
                        "squares disagree on their border from {}, {} to {}, {}, far from any outline",
                        gap.from.x, gap.from.y, gap.to.x, gap.to.y);
            }
    return {};
}

/// The whole, and close to where outlines are, with pixels as large as the tolerance.
std::string errorViolation(const Scene& scene, const Outlines& outlines, const asset::Asset& asset,
                           double tolerance, std::uint64_t seed) {
    const double side = std::max(scene.width, scene.height);
    const Window overview{
        {side / 2, side / 2}, 1.1 * side / overviewPixels, overviewPixels, tolerance * side};
    std::string found = difference(scene, outlines, asset, overview, colourBound);
    for (const scene::Point& p : outlines.somePoints(seed, closeUps))
        if (found.empty())
            found = difference(scene, outlines, asset,
                               {p, closeUpPixel * tolerance * side, closeUpPixels, tolerance * side},
                               colourBound + latticeOpening);
    return found;
}

/// Empty, or the property that does not hold.
std::string violation(const Scene& scene, std::uint64_t seed) {
    const compiler::Options options = optionsOf(seed);
    const compiler::Result result = compiler::compile(scene, options);
    const asset::Asset& asset = result.asset;
    if (asset.fallbackLeaves > 0)
        return fmt::format("{} leaves are not certified", asset.fallbackLeaves);
    if (!(result.provenError <= options.tolerance))
        return fmt::format("only {} tolerances are proven", result.provenError / options.tolerance);
    if (std::string found = strayPiece(asset, options.tolerance); !found.empty())
        return found;
    if (std::string found = openLoop(asset); !found.empty())
        return found;
    const Outlines outlines(scene);
    if (std::string found = borderViolation(scene, outlines, asset, options.tolerance); !found.empty())
        return found;
    if (std::string found = errorViolation(scene, outlines, asset, options.tolerance, seed); !found.empty())
        return found;
    if (seed % repeatedEvery == 0 &&
        asset::write(asset) != asset::write(compiler::compile(scene, options).asset))
        return "two runs give different bytes";
    return {};
}

std::string violationOrException(const Scene& scene, std::uint64_t seed) {
    try {
        return violation(scene, seed);
    } catch (const std::exception& error) {
        return std::string("threw: ") + error.what();
    }
}

// ---- many scenes ------------------------------------------------------------------------------

#ifdef __SANITIZE_ADDRESS__
constexpr std::uint64_t allScenes = 1000;  // ten times slower each
#else
constexpr std::uint64_t allScenes = 10'000;
#endif
constexpr std::uint64_t shards = 25;

class RandomScenes : public testing::TestWithParam<std::uint64_t> {};
INSTANTIATE_TEST_SUITE_P(Shard, RandomScenes, testing::Range(std::uint64_t{0}, shards));

/// A violation without its figures: a scene is shrunk while it keeps failing in one way.
std::string kindOf(const std::string& violation) {
    return violation.substr(0, violation.find_first_of("0123456789"));
}

void check(std::uint64_t seed) {
    const Scene scene = generate::randomScene(seed);
    const std::string found = violationOrException(scene, seed);
    if (found.empty())
        return;
    const Scene small = generate::shrink(
        scene, [&](const Scene& s) { return kindOf(violationOrException(s, seed)) == kindOf(found); });
    const compiler::Options options = optionsOf(seed);
    ADD_FAILURE() << "seed " << seed << ": " << found
                  << "\nsmallest scene that fails: " << violationOrException(small, seed) << "\ntolerance "
                  << options.tolerance << ", nanosecondsPerByte " << options.nanosecondsPerByte
                  << ", piecesPerLeaf " << options.piecesPerLeaf.value_or(0) << " (0: by cost)\n"
                  << dump(small);
}

TEST_P(RandomScenes, KeepEveryProperty) {
    if (std::getenv("VTM_PROPERTY_SEED")) {
        if (GetParam() == 0)
            check(environmentOr("VTM_PROPERTY_SEED", 0));
        return;
    }
    const std::uint64_t usual = std::getenv("VTM_TEST_ALL") ? allScenes : allScenes / 4;
    const std::uint64_t all = environmentOr("VTM_PROPERTY_SCENES", usual);
    for (std::uint64_t seed = GetParam(); seed < all; seed += shards)
        check(seed);
}

// ---- damaged assets ---------------------------------------------------------------------------

/// A disc on a square, and an asset of it that is right.
class Damage : public testing::Test {
protected:
    Damage() {
        const auto add = [&](scene::Path path, scene::Color color) {
            scene::Item item;
            item.path = std::make_shared<scene::Path>(std::move(path));
            item.geometry = scene::FillRule::NonZero;
            item.paint = color;
            scene_.root.children.push_back({item});
        };
        add(scene::rectangle({9.3, 9.2}, {50.1, 51.4}), {1, 0, 0, 1});  // corners inside leaves
        add({scene::MoveTo{{20, 32}}, scene::ArcTo{{13, 13}, 0, false, true, {46, 32}},
             scene::ArcTo{{13, 13}, 0, false, true, {20, 32}}, scene::Close{}},
            {0, 0, 1, 1});
        asset_ = compiler::compile(scene_).asset;
    }
    /// A piece that ends inside its leaf, as stored.
    asset::Piece& innerPiece() {
        for (asset::Piece& piece : asset_.pieces)
            if (asset::sideOf(piece.b) < 0)
                return piece;
        throw std::logic_error("no piece ends inside its leaf");
    }

    Scene scene_{64, 64, {}};
    asset::Asset asset_;
    const double tolerance_ = compiler::Options().tolerance;
};

TEST_F(Damage, IsNotSeenWhereThereIsNone) {
    EXPECT_EQ(strayPiece(asset_, tolerance_), "");
    EXPECT_EQ(openLoop(asset_), "");
    const Outlines outlines(scene_);
    EXPECT_EQ(borderViolation(scene_, outlines, asset_, tolerance_), "");
    EXPECT_EQ(errorViolation(scene_, outlines, asset_, tolerance_, 1), "");
}

TEST_F(Damage, OfAnEndPointOpensALoop) {
    innerPiece().b[0] ^= 1;
    EXPECT_NE(openLoop(asset_), "");
}

TEST_F(Damage, OfAPaintOpensALoop) {
    std::swap(asset_.pieces[0].left, asset_.pieces[0].right);
    EXPECT_NE(openLoop(asset_), "");
}

TEST_F(Damage, OfACornerOpensALoop) {
    asset_.leaves[0].corners[2] ^= 1;
    EXPECT_NE(openLoop(asset_), "");
}

TEST_F(Damage, OfASlopeIsStray) {
    asset_.pieces[0].slopeA = 20000;
    EXPECT_NE(strayPiece(asset_, tolerance_), "");
}

TEST_F(Damage, OfABulgeIsStray) {
    asset::Piece& piece = asset_.pieces[asset_.leaves[0].firstPiece];
    piece.a = {1, 0}, piece.b = {60000, 0}, piece.slopeA = -2000, piece.slopeB = 2000;
    EXPECT_NE(strayPiece(asset_, tolerance_), "");
}

TEST_F(Damage, OfALeafDisagreesWithItsNeighbours) {
    asset::Leaf& leaf = asset_.leaves[0];
    leaf.pieceCount = 0;
    leaf.corners = {1, 1, 1, 1};
    EXPECT_NE(borderViolation(scene_, Outlines(scene_), asset_, tolerance_), "");
}

TEST_F(Damage, OfAColourDiffers) {
    for (asset::Paint& paint : asset_.paints)
        paint[0] = std::bit_cast<std::uint32_t>(0.5f);
    EXPECT_NE(errorViolation(scene_, Outlines(scene_), asset_, tolerance_, 1), "");
}

/// The whole picture three tolerances to the right: seen by close-ups of the outlines only.
TEST_F(Damage, OfTheBoundaryDiffers) {
    asset_.maps[0].x += 3 * tolerance_ * 64;
    const Outlines outlines(scene_);
    EXPECT_EQ(strayPiece(asset_, tolerance_) + openLoop(asset_), "");
    int seen = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed)
        seen += !errorViolation(scene_, outlines, asset_, tolerance_, seed).empty();
    EXPECT_GE(seen, 15);
}

// ---- real files -------------------------------------------------------------------------------

constexpr int closeUpsOfFile = 24;

void expectSound(const std::filesystem::path& file) {
    const compiler::Options options;
    const Scene scene = loadScene(file);
    const compiler::Result result = compiler::compile(scene, options);
    const asset::Asset& asset = result.asset;
    EXPECT_LE(result.provenError, options.tolerance) << file;
    EXPECT_TRUE(result.unproven.empty()) << file;
    EXPECT_EQ(strayPiece(asset, options.tolerance), "") << file;
    EXPECT_EQ(openLoop(asset), "") << file;
    if (!asset.filters.empty())
        return;  // what is seen of their outlines is filtered: suite filters
    const Outlines outlines(scene);
    const double pixel = closeUpPixel * options.tolerance * std::max(scene.width, scene.height);
    for (const scene::Point& p : outlines.somePoints(1, closeUpsOfFile))
        EXPECT_EQ(
            difference(scene, outlines, asset,
                       {p, pixel, closeUpPixels, options.tolerance * std::max(scene.width, scene.height)},
                       colourBound + latticeOpening),
            "")
            << file;
}

TEST(Properties, HoldForTheExamples) {
    for (const auto& entry : std::filesystem::directory_iterator(examplesDirectory()))
        if (entry.path().extension() == ".svg")
            expectSound(entry.path());
}

TEST(Properties, HoldForTheCorpus) {
    const auto corpus = sharedDirectory() / "corpus";
    if (!std::filesystem::exists(corpus))
        GTEST_SKIP() << corpus << " is absent";
    for (const CorpusFile& file : corpusFiles())
        expectSound(corpus / (file.name + ".svg"));
}

}  // namespace
}  // namespace vtm::cases
