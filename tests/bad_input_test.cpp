// Whatever comes in: a picture or the documented exception; never a crash, a hang or a huge
// allocation. A crash ends this process and a hang runs into its timeout, so CTest sees both.

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdlib>
#include <filesystem>
#include <limits>
#include <random>

#include <vtm/asset/container.hpp>
#include <vtm/compiler/compile.hpp>
#include <vtm/image/codec.hpp>
#include <vtm/raster/evaluate.hpp>
#include <vtm/raster/prefilter.hpp>
#include <vtm/svg/load.hpp>
#include "asset/testing_files.hpp"
#include "conformance/generate/damage.hpp"

namespace {

using namespace vtm;
namespace fs = std::filesystem;

constexpr int rasterSide = 64;

/// Far more than any file of the corpus needs, far less than a runaway allocation would take.
constexpr rlim_t addressSpace = rlim_t(6) << 30;

class BadInput : public testing::Test {
protected:
    BadInput() {
#ifndef __SANITIZE_ADDRESS__  // its shadow memory alone is larger
        const rlimit limit{addressSpace, addressSpace};
        EXPECT_EQ(setrlimit(RLIMIT_AS, &limit), 0);
#endif
    }
};

using Bytes = std::vector<std::uint8_t>;

Bytes bytesOf(const std::string& text) { return {text.begin(), text.end()}; }

/// What became of an input.
enum class Outcome { Picture, Refused };

Outcome draw(const scene::Scene& scene) {
    try {
        const compiler::Result result = compiler::compile(scene);
        const asset::View view{
            rasterSide, rasterSide, {rasterSide / scene.width, 0, 0, rasterSide / scene.height, 0, 0}};
        const image::Raster raster = asset::evaluate(result.asset, view);
        EXPECT_EQ(raster.rgba.size(), std::size_t(rasterSide * rasterSide * 4));
        return Outcome::Picture;
    } catch (const compiler::LimitError&) {
        return Outcome::Refused;
    }
}

Outcome draw(const Bytes& bytes) {
    scene::Scene scene;
    try {
        scene = svg::load(bytes).scene;
    } catch (const svg::ParseError& error) {
        EXPECT_FALSE(std::string(error.what()).empty());
        return Outcome::Refused;
    }
    return draw(scene);
}

std::string svgWith(const std::string& content, const std::string& size = "width='64' height='64'") {
    return "<svg xmlns='http://www.w3.org/2000/svg' " + size + ">" + content + "</svg>";
}

TEST_F(BadInput, EmptyFileIsRefused) { EXPECT_EQ(draw(Bytes{}), Outcome::Refused); }

TEST_F(BadInput, NoSvgIsRefused) {
    EXPECT_EQ(draw(bytesOf("not a picture")), Outcome::Refused);
    EXPECT_EQ(draw(bytesOf("<html/>")), Outcome::Refused);
    EXPECT_EQ(draw(Bytes(1000, 0)), Outcome::Refused);
    EXPECT_EQ(draw(Bytes{0x1f, 0x8b, 8, 0}), Outcome::Refused);
}

TEST_F(BadInput, TruncatedXmlIsRefusedEverywhere) {
    const std::string whole = svgWith("<g><path d='M0 0L9 9'/></g>");
    ASSERT_EQ(draw(bytesOf(whole)), Outcome::Picture);
    for (std::size_t length = 0; length < whole.size(); ++length)
        EXPECT_EQ(draw(bytesOf(whole.substr(0, length))), Outcome::Refused) << length << " bytes";
}

TEST_F(BadInput, WildNumbersInPaths) {
    for (const char* data :
         {"M0 0L1e38 1e38L0 64Z", "MNaN 0L9 9L0 9Z", "M0 0LInf 9L0 9Z", "M0 0L1e400 0L0 9Z",
          "M0 0C1e38 -1e38 -1e38 1e38 64 64Z", "M0 0A1e38 1e38 0 1 1 9 9Z", "M0 0A1e-38 9 0 1 1 9 9Z",
          "M-1e300 0H1e300V9H-1e300Z", "M0 0Q1e-320 1e-320 9 9Z", "M0", "L9 9", "M0 0L", "Z"})
        draw(bytesOf(svgWith(std::string("<path stroke='red' d='") + data + "'/>")));
}

TEST_F(BadInput, WildNumbersElsewhere) {
    for (const char* content :
         {"<rect width='1e38' height='1e38' transform='scale(1e38)'/>",
          "<rect width='9' height='9' transform='scale(0)'/>", "<circle r='1e300'/>",
          "<path d='M0 0H9' stroke='red' stroke-width='1e38'/>",
          "<path d='M0 0H1e6' stroke='red' stroke-dasharray='1e-9'/>",
          "<path d='M0 0H64' stroke='red' stroke-dasharray='1e-30 1e30'/>",
          "<use href='#a'/><g id='a'><use href='#a'/></g>",
          "<rect width='9' height='9' fill='url(#g)'/><linearGradient id='g' href='#g'/>"})
        draw(bytesOf(svgWith(content)));
}

TEST_F(BadInput, WildPictureSizes) {
    for (const char* size : {"width='0' height='0'", "width='-5' height='5'", "width='1e38' height='1e38'",
                             "width='1e-38' height='1e-38'", "width='100000' height='100000'",
                             "viewBox='0 0 0 0'", "viewBox='0 0 1e38 1'", "viewBox='nan nan nan nan'"})
        draw(bytesOf(svgWith("<rect width='9' height='9'/>", size)));
}

TEST_F(BadInput, RastersBeyondTheLimitsAreRefused) {
    const asset::Asset asset =
        compiler::compile(svg::load(bytesOf(svgWith("<rect width='9' height='9'/>"))).scene).asset;
    for (const int side : {-1, 100000, std::numeric_limits<int>::max()})
        EXPECT_THROW(asset::evaluate(asset, {side, side, scene::identity}), std::length_error) << side;
}

TEST_F(BadInput, ScenesMadeByHandAreChecked) {
    const double wild[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()};
    for (const double value : wild) {
        scene::Scene scene;
        scene.width = scene.height = 64;
        scene::Item item;
        item.path = std::make_shared<scene::Path>(scene::rectangle({0, 0}, {value, 9}));
        item.geometry = scene::FillRule::NonZero;
        item.paint = scene::Color{};
        scene.root.children.push_back({item});
        EXPECT_THROW(compiler::compile(scene), scene::InvalidScene);
    }
}

TEST_F(BadInput, DeepNestingIsBounded) {
    constexpr int depth = 100000;
    std::string deep;
    for (int i = 0; i < depth; ++i)
        deep += "<g>";
    draw(bytesOf(svgWith(deep)));
    for (int i = 0; i < depth; ++i)
        deep += "</g>";
    draw(bytesOf(svgWith(deep)));
}

TEST_F(BadInput, ABillionUsesAreBounded) {
    std::string content = "<defs><path id='u0' d='M0 0H9V9Z'/>";
    for (int level = 1; level < 12; ++level) {
        content += "<g id='u" + std::to_string(level) + "'>";
        for (int i = 0; i < 10; ++i)
            content += "<use href='#u" + std::to_string(level - 1) + "'/>";
        content += "</g>";
    }
    draw(bytesOf(svgWith(content + "</defs><use href='#u11'/>")));
}

// ---- Corrupted files --------------------------------------------------------------------------

fs::path corpus() {
    const char* shared = std::getenv("VTM_SHARED");
    return (shared != nullptr ? fs::path(shared) : fs::path(VTM_SOURCE_DIR) / "../shared") / "corpus";
}

class CorruptedFile : public BadInput, public testing::WithParamInterface<const char*> {};

/// Drawing a large file takes long; reading 20 corruptions of it does not.
constexpr int corruptions = 20, drawnCorruptions = 3;

TEST_P(CorruptedFile, IsDrawnOrRefused) {
    const fs::path path = corpus() / GetParam();
    if (!fs::exists(path))
        GTEST_SKIP() << path << " is absent";
    const Bytes whole = image::readFile(path.string());
    std::mt19937_64 random(20051u);  // any seed; fixed so that a failure can be repeated
    int drawn = 0;
    for (int i = 0; i < corruptions; ++i) {
        try {
            const scene::Scene scene = svg::load(generate::damaged(whole, random)).scene;
            if (drawn++ < drawnCorruptions)
                draw(scene);
        } catch (const svg::ParseError& error) {
            EXPECT_NE(std::string(error.what()), "");
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Corpus, CorruptedFile,
                         testing::Values("tiger.svg", "paper.svg", "caesar.svg", "world.svg", "counties.svg",
                                         "flag_rs.svg", "flag_mx.svg", "noto_people.svg", "noto_gorilla.svg",
                                         "pflogo.svg", "mdsheet.svg", "gallardo.svg", "fluent_prince.svg"),
                         [](const auto& tested) {
                             const std::string file = tested.param;
                             return file.substr(0, file.find('.'));
                         });

TEST_F(BadInput, CorruptedIconsAreDrawnOrRefused) {
    if (!fs::exists(corpus() / "icons"))
        GTEST_SKIP() << corpus() / "icons"
                     << " is absent";
    std::mt19937_64 random(20052u);
    for (const fs::directory_entry& entry : fs::directory_iterator(corpus() / "icons")) {
        const Bytes whole = image::readFile(entry.path().string());
        for (int i = 0; i < corruptions; ++i)
            draw(generate::damaged(whole, random));
    }
}

/// Reads a file from memory and draws it: Refused, if with the documented error.
Outcome drawAsset(const Bytes& bytes) {
    try {
        const asset::Asset asset = asset::read(bytes);
        asset::evaluate(asset, {8, 8, {8 / asset.width, 0, 0, 8 / asset.height, 0, 0}});
        asset::summarize(asset);
        return Outcome::Picture;
    } catch (const asset::FormatError& error) {
        EXPECT_NE(std::string(error.what()), "");
        return Outcome::Refused;
    }
}

/// As they are, checksums stop nearly all of them; put right, what stands behind the checksums has to.
TEST_F(BadInput, CorruptedAssetsAreRefusedOrDrawn) {
    asset::Asset made =
        compiler::compile(svg::load(bytesOf(svgWith("<circle cx='30' cy='30' r='20'/>"))).scene).asset;
    made.prefilter = asset::buildPrefilter(made, asset::PyramidSize{8, 8});
    const Bytes whole = asset::write(made);
    ASSERT_EQ(drawAsset(whole), Outcome::Picture);
    std::mt19937_64 random(20053u);
    for (int i = 0; i < 1000; ++i) {
        Bytes bytes = generate::damaged(whole, random);
        drawAsset(bytes);
        if (bytes.size() >= asset::test::headerBytes) {
            asset::test::fixChecksums(bytes);
            drawAsset(bytes);
        }
    }
}

}  // namespace
