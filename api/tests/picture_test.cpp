// The facade, through libvtm as users link it.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <vtm/asset/asset.hpp>
#include <vtm/asset/container.hpp>
#include <vtm/image/codec.hpp>
#include <vtm/scene/scene.hpp>
#include <vtm/svg/load.hpp>
#include <vtm/vtm.hpp>
#include <vtm/vtmtree.hpp>

namespace vtm {
namespace {

namespace fs = std::filesystem;

std::vector<std::uint8_t> bytesOf(const std::string& text) { return {text.begin(), text.end()}; }

Picture svg(const std::string& attributes, const std::string& content) {
    return Picture::load(
        bytesOf(R"(<svg xmlns="http://www.w3.org/2000/svg" )" + attributes + ">" + content + "</svg>"),
        {.name = "test.svg"});
}

/// Red on the left, blue on the right.
Picture halves() {
    return svg(R"(width="4" height="2")", R"(<rect width="2" height="2" fill="red"/>)"
                                          R"(<rect x="2" width="2" height="2" fill="blue"/>)");
}

std::string pixel(const Image& image, int x, int y) {
    const std::uint8_t* p = &image.rgba[(std::size_t(y) * std::size_t(image.width) + std::size_t(x)) * 4];
    if (p[3] == 0)
        return "none";
    if (p[3] != 255)
        return "mixed";
    return p[0] == 255 && p[1] == 0 && p[2] == 0   ? "red"
           : p[0] == 0 && p[1] == 0 && p[2] == 255 ? "blue"
                                                   : "other";
}

/// A row of pixels.
std::string row(const Image& image, int y) {
    std::string names;
    for (int x = 0; x < image.width; ++x)
        names += (x > 0 ? " " : "") + pixel(image, x, y);
    return names;
}

class PictureFiles : public testing::Test {
protected:
    void SetUp() override { fs::create_directories(folder_); }
    void TearDown() override { fs::remove_all(folder_); }
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    void write(const std::string& name, const std::string& text) const { std::ofstream(path(name)) << text; }

private:
    const fs::path folder_ = fs::temp_directory_path() / ("vtm_picture_test_" + std::to_string(getpid()));
};

TEST(Picture, OneSideKeepsTheAspect) {
    const Picture picture = halves();
    EXPECT_EQ(picture.width(), 4);
    EXPECT_EQ(picture.height(), 2);
    const Image byWidth = picture.render({.width = 8}), byHeight = picture.render({.height = 8});
    EXPECT_EQ(byWidth.height, 4);
    EXPECT_EQ(byHeight.width, 16);
    EXPECT_EQ(picture.render().width, 4);
    EXPECT_EQ(picture.render({.scale = 2.5}).width, 10);
}

TEST(Picture, BothSidesFitAsAsked) {
    const Picture picture = halves();
    const Image contained = picture.render({.width = 4, .height = 4});
    EXPECT_EQ(row(contained, 0), "none none none none");
    EXPECT_EQ(row(contained, 1), "red red blue blue");
    EXPECT_EQ(row(contained, 3), "none none none none");
    EXPECT_EQ(row(picture.render({.width = 4, .height = 4, .fit = Fit::Cover}), 0), "red red blue blue");
    EXPECT_EQ(row(picture.render({.width = 2, .height = 4, .fit = Fit::Stretch}), 3), "red blue");
}

TEST(Picture, ViewsAreByRectangleRotationAndMatrix) {
    const Picture picture = halves();
    EXPECT_EQ(row(picture.render({.view = Rectangle{1, 0, 2, 2}}), 0), "red blue");
    EXPECT_EQ(row(picture.render({.view = Rectangle{3, 0, 2, 2}}), 0), "blue none");
    EXPECT_EQ(row(picture.render({.rotation = 180}), 0), "blue blue red red");
    const Image turned = picture.render({.rotation = 90});
    EXPECT_EQ(turned.width, 2);
    EXPECT_EQ(row(turned, 0), "red red");
    EXPECT_EQ(row(turned, 3), "blue blue");
    const Image mirrored = picture.render({.width = 4, .height = 1, .matrix = {{-1, 0, 0, 1, 4, 0}}});
    EXPECT_EQ(row(mirrored, 0), "blue blue red red");
}

TEST(Picture, BackgroundLiesUnderneath) {
    const Picture picture =
        svg(R"(width="2" height="1")", R"(<rect width="1" height="1" fill="red" fill-opacity=".5"/>)");
    const Image image = picture.render({.background = {0, 0, 1, 1}});
    EXPECT_EQ(pixel(image, 1, 0), "blue");
    EXPECT_NEAR(image.rgba[0], 128, 1);
    EXPECT_NEAR(image.rgba[2], 128, 1);
    EXPECT_EQ(image.rgba[3], 255);
}

/// Outlines that the whole picture is too coarse for are compiled anew, by frames and by matrices.
TEST(Picture, DeepZoomsAreSharp) {
    const Picture picture =
        svg(R"(width="1000" height="1000")", R"(<path fill="red" d="M0 0H500.00001V1000H0Z"/>)");
    constexpr double side = 1e-5;  // the edge lies in the middle of the third of five pixels
    const double x = 500.00001 - 2.5 * side, scale = 1 / side;
    const Image byView = picture.render({.width = 5, .view = Rectangle{x, 500, 5 * side, side}});
    const Image byMatrix =
        picture.render({.width = 5, .height = 1, .matrix = {{scale, 0, 0, scale, -x * scale, -500 * scale}}});
    for (const Image& image : {byView, byMatrix}) {
        EXPECT_EQ(row(image, 0), "red red mixed none none");
        EXPECT_NEAR(image.rgba[2 * 4 + 3], 128, 16);
    }
}

/// Between the sizes that the usual tolerance suffices for and deep zooms.
TEST(Picture, LargeViewsAreAsExactWhenTheyAreDrawnAgain) {
    std::string petals;
    for (int i = 0; i < 90; ++i)
        petals += "<ellipse rx='" + std::to_string(49 - 0.5 * i) + "' ry='" +
                  std::to_string(31.7 - 0.33 * i) + "' transform='translate(50 50) rotate(" +
                  std::to_string(11 * i) + ")'/>";
    for (const double scale : {8.0, 38.0, 150.0}) {  // 800, 3800 and 15 000 pixels
        const Picture picture =
            svg(R"(width="100" height="100" fill="none" stroke="#000" stroke-width=".1")", petals);
        const RenderOptions options{.width = 400,
                                    .height = 400,
                                    .matrix = {{scale, 0, 0, scale, -40 * scale, -31 * scale}},
                                    .engine = Engine::Cpu};
        const Image first = picture.render(options), again = picture.render(options);
        int largest = 0;
        for (std::size_t i = 0; i < first.rgba.size(); ++i)
            largest = std::max(largest, std::abs(first.rgba[i] - again.rgba[i]));
        EXPECT_LE(largest, 3) << scale;
    }
}

TEST(Picture, WarningsAreValues) {
    const Picture picture =
        svg(R"(width="4" height="4")", "<text>a</text><rect fill=\"url(#no)\" width=\"x\"/>");
    const auto warnings = picture.warnings();
    ASSERT_GE(warnings.size(), 2u);
    EXPECT_TRUE(warnings[0].starts_with("test.svg:1:")) << warnings[0];
    picture.render();
    EXPECT_EQ(picture.warnings().size(), warnings.size());
}

TEST(Picture, TextsOfTreesAreKnownByTheirFirstWord) {
    const Picture picture =
        Picture::load(bytesOf("vtmtree 1 size 4 2 draw select rect(0 0, 2 2) red else blue"));
    EXPECT_EQ(picture.width(), 4);
    const Image image = picture.render();
    EXPECT_EQ(image.rgba[0], 255);
    EXPECT_EQ(image.rgba[3 * 4 + 2], 255);
    EXPECT_THROW(Picture::load(bytesOf("vtmtree 1 draw red")), TreeError);
    EXPECT_THROW(Picture::load(bytesOf("size 4 2 draw red"), {.name = "a.vtmtree"}), TreeError);
}

TEST(Picture, EveryErrorIsAnError) {
    EXPECT_THROW(Picture::load("no such file.svg"), Error);
    EXPECT_THROW(Picture::load(bytesOf("<svg")), svg::ParseError);
    EXPECT_THROW(Picture::load(bytesOf("VTM")), Error);
    EXPECT_THROW(Picture(scene::Scene{}), scene::InvalidScene);
    const Image image = halves().render();
    EXPECT_THROW(image.save("/no/such/folder/a.png"), image::CodecError);
    EXPECT_THROW(image.save("a.unknown"), image::CodecError);
}

TEST(Picture, OptionsThatContradictThemselvesAreRefused) {
    const Picture picture = halves();
    EXPECT_THROW(picture.render({.width = 0}), std::invalid_argument);
    EXPECT_THROW(picture.render({.scale = -1}), std::invalid_argument);
    EXPECT_THROW(picture.render({.scale = std::numeric_limits<double>::quiet_NaN()}), std::invalid_argument);
    EXPECT_THROW(picture.render({.view = Rectangle{0, 0, 0, 1}}), std::invalid_argument);
    EXPECT_THROW(picture.render({.rotation = std::numeric_limits<double>::infinity()}),
                 std::invalid_argument);
    EXPECT_THROW(picture.render({.matrix = {{1, 0, 0, 1, 0, 0}}}), std::invalid_argument);
    EXPECT_THROW(picture.render({.width = 2, .height = 2, .rotation = 1, .matrix = {{1, 0, 0, 1, 0, 0}}}),
                 std::invalid_argument);
    EXPECT_THROW(picture.render({.width = 20000}), std::length_error);
    EXPECT_THROW(picture.render({.scale = 1e300}), std::length_error);
    EXPECT_THROW(picture.render({.width = 2, .height = 2, .matrix = {{1e300, 0, 0, 1e300, 0, 0}}}),
                 std::length_error);
    EXPECT_EQ(row(picture.render({.width = 2, .height = 1, .matrix = {{0, 0, 0, 0, 0, 0}}}), 0), "none none");
}

TEST(Picture, HugeSizesAreToldInFewDigits) {
    try {
        halves().render({.scale = 1e60});
        FAIL();
    } catch (const std::length_error& error) {
        EXPECT_NE(std::string(error.what()).find("e+60 x "), std::string::npos) << error.what();
    }
}

/// Of this process so far, bytes.
std::size_t peakMemory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return std::size_t(usage.ru_maxrss) * 1024;
}

TEST(Picture, DrawingOnTheCpuHoldsBytesNotFloats) {
    const Picture picture = halves();
    picture.render({.width = 16, .engine = Engine::Cpu});
    const std::size_t before = peakMemory();
    const Image image = picture.render({.width = 4096, .height = 4096, .engine = Engine::Cpu});
    constexpr std::size_t rest = 32 << 20;  // whatever else the process takes
    EXPECT_LT(peakMemory() - before, image.rgba.size() + rest);
}

TEST(Picture, ThreadsShareOne) {
    const Picture picture = halves();
    std::vector<std::string> rows(4);
    std::vector<std::thread> threads;
    for (std::string& found : rows)
        threads.emplace_back([&picture, &found] { found = row(picture.render(), 0); });
    for (std::thread& thread : threads)
        thread.join();
    for (const std::string& found : rows)
        EXPECT_EQ(found, "red red blue blue");
}

TEST_F(PictureFiles, CompiledFilesDrawTheSame) {
    write("halves.svg",
          R"(<svg xmlns="http://www.w3.org/2000/svg" width="4" height="2"><circle r="2" fill="red"/></svg>)");
    const Picture written = Picture::load(path("halves.svg"));
    written.save(path("halves.vtm"));
    const Picture read = Picture::load(path("halves.vtm"));
    EXPECT_EQ(read.width(), 4);
    EXPECT_EQ(read.render({.width = 40}).rgba, written.render({.width = 40}).rgba);
    EXPECT_EQ(Picture(asset::read(image::readFile(path("halves.vtm")))).render().rgba, read.render().rgba);
}

TEST_F(PictureFiles, DamagedFilesAreNamed) {
    write("bad.vtm", "nothing of the kind");
    write("bad.svg", "<svg><");
    for (const std::string name : {"bad.vtm", "bad.svg"}) {
        try {
            Picture::load(path(name));
            ADD_FAILURE() << name << " was loaded";
        } catch (const Error& error) {
            EXPECT_TRUE(std::string(error.what()).starts_with(path(name))) << error.what();
        }
    }
}

TEST_F(PictureFiles, ReferencesStartAtTheFile) {
    Image image = halves().render();
    for (const std::string suffix : {".png", ".jpg", ".webp"}) {
        image.save(path("halves" + suffix));
        EXPECT_EQ(image::decode(image::readFile(path("halves" + suffix))).width, 4) << suffix;
    }
    EXPECT_EQ(image::decode(image::readFile(path("halves.png"))).rgba, image.rgba);
    const std::string text =
        R"(<svg xmlns="http://www.w3.org/2000/svg" width="4" height="2">)"
        R"(<image href="halves.png" width="4" height="2" image-rendering="pixelated"/></svg>)";
    write("refers.svg", text);
    EXPECT_EQ(row(Picture::load(path("refers.svg")).render(), 0), "red red blue blue");
    const Picture fromBytes = Picture::load(bytesOf(text), {.name = "refers.svg"});
    EXPECT_EQ(row(fromBytes.render(), 0), "none none none none");
    EXPECT_EQ(fromBytes.warnings().size(), 1u);
}

}  // namespace
}  // namespace vtm
