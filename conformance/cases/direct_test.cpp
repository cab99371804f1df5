// Pictures that are drawn once, from the scene itself, against those that are drawn from the compiled asset:
// random scenes, hard ones and real files; whole, turned, small and magnified.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <random>
#include <string>
#include <system_error>
#include <vector>

#include <gtest/gtest.h>

#include <fmt/core.h>

#include <vtm/compiler/draw_view.hpp>
#include <vtm/raster/evaluator.hpp>
#include <vtm/raster/scan.hpp>
#include <vtm/svg/load.hpp>
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

/// Scenes that are compiled in any case, and those whose compiled picture is not proven, say nothing: then
/// false.
bool compareDrawings(const scene::Scene& scene, const std::string& name) {
    // Nearer to the true picture than usual, since chords of assets all lie on one side of their curves.
    compiler::Options options;
    options.tolerance /= 4;
    const compiler::Result compiled = compiler::compile(scene, options);
    if (!compiled.unproven.empty() || compiled.asset.fallbackLeaves > 0 ||
        !asset::isSumOfMaps(compiled.asset))
        return false;
    const asset::Scanner scanner(compiled.asset);
    for (const Looked& looked : views) {
        const asset::View view = viewOf(scene, looked);
        const auto drawing = compiler::ViewDrawing::make(scene, view);
        if (!drawing)
            return false;
        const compare::Difference d = compare::compare(drawing->draw(), scanner.draw(view));
        EXPECT_LE(d.max, mostApart) << name << ", " << looked.name << " at " << d.worstX << ", " << d.worstY;
        EXPECT_LE(d.rms, rmsApart) << name << ", " << looked.name;
    }
    return true;
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

// ---- More than can be followed -----------------------------------------------------------------------

scene::Scene sceneOf(const std::string& content) {
    const std::string svg =
        fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"64\" height=\"64\">{}</svg>", content);
    return svg::load({reinterpret_cast<const std::uint8_t*>(svg.data()), svg.size()}, {}).scene;
}

/// `between`: in [0, 64), the same everywhere.
class Numbers {
public:
    double between() { return 64 * std::ldexp(double(random_() >> 11), -53); }
    unsigned color() { return unsigned(random_() & 0xFFFFFFu); }

private:
    std::mt19937_64 random_{1};
};

std::string crossingLines(int count, const char* rule) {
    Numbers numbers;
    std::string path = fmt::format("<path fill=\"#728\" fill-rule=\"{}\" d=\"M32,32", rule);
    for (int i = 0; i < count; ++i) {
        const double x = numbers.between(), y = numbers.between();
        path += fmt::format("L{:.3f},{:.3f}", x, y);
    }
    return path + "Z\"/>";
}

std::string stackedCircles(int count, const char* style = "fill-opacity:.5") {
    Numbers numbers;
    std::string circles;
    for (int i = 0; i < count; ++i) {
        const double x = numbers.between(), y = numbers.between();
        circles += fmt::format("<circle cx=\"{:.3f}\" cy=\"{:.3f}\" r=\"4\" fill=\"#{:06x}\" style=\"{}\"/>",
                               x, y, numbers.color(), style);
    }
    return circles;
}

/// Each with a clip of its own, which lets through all of it, nothing or a part.
std::string clippedRectangles(int count) {
    Numbers numbers;
    std::string rectangles = "<clipPath id=\"c\"><circle cx=\"32\" cy=\"32\" r=\"20\"/></clipPath>";
    for (int i = 0; i < count; ++i) {
        const double x = numbers.between(), y = numbers.between(), turn = numbers.between();
        rectangles += fmt::format(
            "<rect x=\"{:.3f}\" y=\"{:.3f}\" width=\"3\" height=\"3\" transform=\"rotate({:.2f} 30 30)\" "
            "fill=\"#{:06x}\" fill-opacity=\".5\" clip-path=\"url(#c)\"/>",
            x, y, turn, numbers.color());
    }
    return rectangles;
}

/// Each with a gradient across its own box.
std::string gradientStrokes(int count, const char* style) {
    Numbers numbers;
    std::string strokes =
        "<linearGradient id=\"g\" gradientUnits=\"userSpaceOnUse\" x2=\"64\"><stop stop-color=\"#e33\" "
        "stop-opacity=\".5\"/><stop offset=\"1\" "
        "stop-color=\"#23c\"/></linearGradient>";
    for (int i = 0; i < count; ++i) {
        const double a = numbers.between(), b = numbers.between(), c = numbers.between(),
                     d = numbers.between();
        strokes += fmt::format("<path d=\"M{:.3f},{:.3f}L{:.3f},{:.3f}\" stroke=\"url(#g)\" style=\"{}\"/>",
                               a, b, c, d, style);
    }
    return strokes;
}

std::string grid(int lines) {
    std::string path =
        fmt::format("<path fill=\"none\" stroke=\"#000\" stroke-width=\"{}\" d=\"", 0.3 * 64 / lines);
    for (int i = 0; i < lines; ++i)
        path += fmt::format("M{0:.5f},0V64M0,{0:.5f}H64", 64 * (i + 0.5) / lines);
    return path + "\"/>";
}

/// Largest difference of a picture from the means of squares of a larger one.
double differenceFromLarger(const scene::Scene& scene, int times) {
    const image::Raster small = compiler::ViewDrawing::make(scene, wholePicture(scene, 64))->draw(),
                        large = compiler::ViewDrawing::make(scene, wholePicture(scene, 64 * times))->draw();
    double most = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < 4; ++c) {
                double sum = 0;
                for (int i = 0; i < times * times; ++i)
                    sum += large.pixel(x * times + i % times, y * times + i / times)[c];
                most = std::max(most, std::abs(sum / (times * times) - double(small.pixel(x, y)[c])));
            }
    return 255 * most;
}

TEST(DrawnOnce, DensePicturesAreTheMeansOfLargerOnes) {
    EXPECT_LE(differenceFromLarger(sceneOf(crossingLines(2000, "evenodd")), 4), 1.0);
    EXPECT_LE(differenceFromLarger(sceneOf(stackedCircles(10000)), 4), 1.0);
    EXPECT_LE(differenceFromLarger(sceneOf(stackedCircles(1000, "mix-blend-mode:multiply")), 4), 1.0);
    EXPECT_LE(differenceFromLarger(sceneOf(clippedRectangles(5000)), 4), 1.0);
}

/// Lines of a grid, or anywhere, by twenty or more to a pixel, each of a colour of its own; `inGroup`
/// together in a translucent group.
std::string manyLines(int count, bool isGrid, int inGroup) {
    Numbers numbers;
    std::string content;
    for (int i = 0; i < count; ++i) {
        const double at = 64 * (i + 0.5) / count, x1 = numbers.between(), y1 = numbers.between(),
                     x2 = numbers.between(), y2 = numbers.between();
        const unsigned color = numbers.color();
        if (inGroup > 0 && i % inGroup == 0)
            content += "<g opacity=\".6\">";
        content += isGrid && i % 2 == 0 ? fmt::format("<path d=\"M0,{0:.5f}H64\"", at)
                   : isGrid             ? fmt::format("<path d=\"M{0:.5f},0V64\"", at)
                            : fmt::format("<path d=\"M{:.3f},{:.3f}L{:.3f},{:.3f}\"", x1, y1, x2, y2);
        content += fmt::format(" stroke=\"#{:06x}\" stroke-opacity=\".4\"/>", color);
        if (inGroup > 0 && i % inGroup == inGroup - 1)
            content += "</g>";
    }
    return content;
}

/// Too much to follow: asked for at places.
TEST(DrawnOnce, ManyLayersAreTheMeansOfLargerPictures) {
    for (const int inGroup : {0, 4})
        for (const bool isGrid : {false, true})
            EXPECT_LE(differenceFromLarger(sceneOf(manyLines(1600, isGrid, inGroup)), 4), 1.5)
                << inGroup << ", " << isGrid;
}

/// Opaque: four corners each, which cross themselves, or two strokes across each other.
std::string manyMarks(int count, bool areStrokes) {
    Numbers numbers;
    const auto by = [&] { return numbers.between() / 8 - 4; };
    std::string content;
    for (int i = 0; i < count; ++i) {
        content += fmt::format("<path d='M{:.3f},{:.3f}", numbers.between(), numbers.between());
        content += areStrokes ? std::string("m-1,0h2m-1,-1v2' stroke-width='.5' stroke")
                              : fmt::format("l{:.3f},{:.3f} {:.3f},{:.3f} {:.3f},{:.3f}z' fill", by(), by(),
                                            by(), by(), by(), by());
        content +=
            fmt::format("='#{:06x}'{}/>", numbers.color(),
                        areStrokes ? fmt::format(" transform='rotate({:.1f})'", numbers.between()) : "");
    }
    return content;
}

std::string randomCurve(int segments) {
    Numbers numbers;
    std::string path = "<path fill='#264' d='M32,32";
    for (int i = 0; i < segments; ++i)
        path += fmt::format("Q{:.3f},{:.3f} {:.3f},{:.3f}", numbers.between(), numbers.between(),
                            numbers.between(), numbers.between());
    return path + "Z'/>";
}

/// Chains that begin and end between others in a row of squares, that go up and down again there, that leave
/// a square at its side; and slabs that are begun anew because they would take too much.
TEST(DrawnOnce, WhatIsAskedForAtPlacesIsTheMeanOfLargerPictures) {
    for (const int count : {6000, 8000, 10000, 16000}) {
        EXPECT_LE(differenceFromLarger(sceneOf(manyMarks(count, false)), 4), 1.5) << count;
        EXPECT_LE(differenceFromLarger(sceneOf(manyMarks(count, true)), 4), 1.5) << count;
        EXPECT_LE(differenceFromLarger(sceneOf(randomCurve(count)), 4), 2.5) << count;
    }
}

/// Beside what they clip, round it, round it with a hole there, and across it.
TEST(DrawnOnce, ClipsThatDoNotMeetWhatTheyClipLetAllOfItThroughOrNothing) {
    for (const char* clip :
         {"M0,0H9V64H0Z", "M55,0H64V64H55Z", "M0,0H64V9H0Z", "M5,5H60V60H5Z", "M5,5H60V60H5ZM10,10H50V50H10Z",
          "M5,5H60V60H5ZM10,10H50V50H10ZM9,9H51V51H9Z", "M0,0L64,30V64H0Z", "M20,20H40V40H20Z"})
        for (const char* rule : {"evenodd", "nonzero"})
            for (const char* inner :
                 {"", "<clipPath id=\"i\"><circle cx=\"30\" cy=\"30\" r=\"29\"/></clipPath>"}) {
                const scene::Scene scene = sceneOf(fmt::format(
                    "{0}<clipPath id=\"c\" clip-path=\"url(#i)\"><path clip-rule=\"{1}\" "
                    "d=\"{2}\"/></clipPath>"
                    "<g clip-path=\"url(#c)\"><circle cx=\"30\" cy=\"30\" r=\"15\" fill=\"#e33\"/></g>"
                    "<g opacity=\".5\" clip-path=\"url(#c)\"><rect x=\"20\" y=\"20\" width=\"4\" "
                    "height=\"20\"/>"
                    "</g>",
                    inner, rule, clip));
                compareDrawings(scene, fmt::format("{} {} {}", clip, rule, inner));
            }
}

/// A hundred edges and a thousand crossings in a pixel: level steps misplace triangles in both pictures.
TEST(DrawnOnce, LevelStepsAreNearTheMeansOfLargerPictures) {
    constexpr double mostMisplaced = 3;
    EXPECT_LE(differenceFromLarger(sceneOf(crossingLines(16000, "nonzero")), 4), mostMisplaced);
}

/// Twenty crossings in a pixel, between regions each of which has a program of its own.
TEST(DrawnOnce, ProgramsInLevelStepsAreNearTheMeansOfLargerPictures) {
    for (const char* style : {"stroke-width:.5", "stroke-width:.5;opacity:.7;mix-blend-mode:multiply"}) {
        const double most = differenceFromLarger(sceneOf(gradientStrokes(400, style)), 4);
        EXPECT_LE(most, 3.0) << style;
    }
}

/// Some hundred edges a pixel, and fewer at the sides. What is off is the mean of lines, whose shares have
/// the standard deviation 0.5/√edges each.
TEST(DrawnOnce, TangledPicturesAreNearTheMeansOfLargerOnes) {
    constexpr double edges = 64000 / 3.0 / 64, lines = 400000 / (64000 / 3.0), deviations = 8;
    EXPECT_LE(differenceFromLarger(sceneOf(crossingLines(64000, "evenodd")), 4),
              deviations * 255 * 0.5 / std::sqrt(edges * lines));
}

/// Pixel by pixel where no other edge is seen; crossing by crossing, or in level steps, beside a rectangle's.
TEST(DrawnOnce, TangledPicturesAreTheSameBesideAnEdge) {
    const auto drawn = [](double width, const char* rule) {
        const scene::Scene scene =
            sceneOf(fmt::format("<rect width=\"{}\" height=\"64\" fill=\"#fe8\"/>", width) +
                    crossingLines(4000, rule));
        return compiler::ViewDrawing::make(scene, wholePicture(scene, 64))->draw();
    };
    for (const char* rule : {"evenodd", "nonzero"}) {
        const image::Raster alone = drawn(64, rule), beside = drawn(63.5, rule);
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 63; ++x)
                for (int c = 0; c < 4; ++c)
                    ASSERT_NEAR(alone.pixel(x, y)[c], beside.pixel(x, y)[c], mostApart / 255)
                        << rule << ", " << x << ", " << y;
    }
}

std::string starOf(int points) {
    std::string path = "<path fill=\"#408020\" d=\"M32,1";
    for (int i = 1; i < points; ++i) {
        const double angle = std::numbers::pi * (i + double(i) / points);
        path += fmt::format("L{:.5f},{:.5f}", 32 + 31 * std::sin(angle), 32 - 31 * std::cos(angle));
    }
    return path + "Z\"/>";
}

/// Nearly level edges by the thousand, which must not cover more than there is of a pixel.
/// All edges are cut by the rows through the middle, where those at the sides are nearly level and cross each
/// other: what is off is what each misplaces in a thin step.
TEST(DrawnOnce, NearlyLevelEdgesAreNearTheMeansOfLargerPictures) {
    const scene::Scene scene = sceneOf(starOf(100000));
    constexpr int times = 8, width = 500, rows = 8;
    const auto middle = [&](int larger) {
        const double scale = width * larger / scene.width, top = (width - rows) / 2 * larger;
        const asset::View view{width * larger, rows * larger, {scale, 0, 0, scale, 0, -top}};
        return compiler::ViewDrawing::make(scene, view)->draw();
    };
    const image::Raster small = middle(1), large = middle(times);
    constexpr double mostMisplaced = 15;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < width; ++x) {
            double sum = 0;
            for (int i = 0; i < times * times; ++i)
                sum += large.pixel(x * times + i % times, y * times + i / times)[3];
            ASSERT_NEAR(255 * sum / (times * times), 255 * small.pixel(x, y)[3], mostMisplaced)
                << x << ", " << y;
        }
}

TEST(DrawnOnce, DensePicturesOfOneColourHaveNoOther) {
    const scene::Scene scene = sceneOf(starOf(100000));
    const image::Raster drawn = compiler::ViewDrawing::make(scene, wholePicture(scene, 500))->draw();
    constexpr float color[4]{0x40 / 255.0f, 0x80 / 255.0f, 0x20 / 255.0f, 1};
    for (int y = 0; y < drawn.height; ++y)
        for (int x = 0; x < drawn.width; ++x)
            for (int c = 0; c < 4; ++c)
                ASSERT_NEAR(drawn.pixel(x, y)[c], drawn.pixel(x, y)[3] * color[c], 1.0 / 255)
                    << x << ", " << y;
}

/// A hundred thousand edges go level through the middle, and end at the star's sides.
TEST(DrawnOnce, NothingShowsBesideDenseOutlines) {
    const scene::Scene scene = sceneOf(starOf(100000) + "<circle r=\".01\"/>");
    constexpr int width = 500;
    constexpr double radius = 31.0 / 64 * width, pixel = 1.5;
    constexpr float rounded = 0.01f / 255;  // a hundredth of a step of 8 bits
    const image::Raster drawn = compiler::ViewDrawing::make(scene, wholePicture(scene, width))->draw();
    for (int y = 1; y < drawn.height; ++y)
        for (int x = 1; x < drawn.width; ++x)
            if (std::hypot(x + 0.5 - 0.5 * width, y + 0.5 - 0.5 * width) > radius + pixel) {
                ASSERT_LE(drawn.pixel(x, y)[3], rounded) << x << ", " << y;
            }
}

TEST(DrawnOnce, GridsFinerThanPixelsAreGrey) {
    const scene::Scene scene = sceneOf(grid(6400));
    const image::Raster drawn = compiler::ViewDrawing::make(scene, wholePicture(scene, 64))->draw();
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            ASSERT_NEAR(drawn.pixel(x, y)[3], 1 - 0.7 * 0.7, 1.0 / 255) << x << ", " << y;
}

/// So many that those are looked for that are hidden, step by step.
std::string nearlyEqualCircles(int count) {
    Numbers numbers;
    const auto nearly = [&](double value) { return value + (numbers.between() / 64 - 0.5) / 8; };
    std::string circles;
    for (int i = 0; i < count; ++i) {
        const double x = nearly(32), y = nearly(32), r = nearly(25);
        circles += fmt::format(
            "<circle cx=\"{:.4f}\" cy=\"{:.4f}\" r=\"{:.4f}\" fill=\"#{:06x}\" fill-opacity=\".5\"/>", x, y,
            r, numbers.color());
    }
    return circles;
}

/// In a clip that leaves out a corner nothing is hidden: no layer is known to cover all of its inside.
TEST(DrawnOnce, HiddenOutlinesChangeNothing) {
    const std::string circles = nearlyEqualCircles(20000);
    const std::string clip = "<clipPath id=\"c\"><path d=\"M29,-9H99V99H-9V29Z\"/></clipPath>";
    const scene::Scene plain = sceneOf(circles),
                       clipped = sceneOf(clip + "<g clip-path=\"url(#c)\">" + circles + "</g>");
    const image::Raster some = compiler::ViewDrawing::make(plain, wholePicture(plain, 64))->draw(),
                        all = compiler::ViewDrawing::make(clipped, wholePicture(clipped, 64))->draw();
    for (std::size_t i = 0; i < some.rgba.size(); ++i)
        ASSERT_NEAR(some.rgba[i], all.rgba[i], 1.0 / 255) << i;
    EXPECT_LE(differenceFromLarger(plain, 4), 1.0);
}

/// Squares in squares, black and white in turn, round the middle of a picture of 64.
scene::Scene nestedSquares(int count) {
    scene::Scene scene;
    scene.width = scene.height = 64;
    for (int i = 0; i < count; ++i) {
        const double from = 32.0 * i / count;
        const float grey = i % 2 == 0 ? 0 : 1;
        scene::Item item;
        item.path =
            std::make_shared<const scene::Path>(scene::rectangle({from, from}, {64 - from, 64 - from}));
        item.paint = scene::Color{grey, grey, grey, 1};
        scene.root.children.push_back({item});
    }
    return scene;
}

/// Seventy level sides in a pixel, which no chain tells of.
TEST(DrawnOnce, LevelSidesInLevelStepsAreExact) {
    const scene::Scene scene = nestedSquares(90000);
    constexpr double scale = 40, left = 30.8, top = 34.0;
    const asset::View view{48, 20, {scale, 0, 0, scale, -scale * left, -scale * top}};
    const image::Raster drawn = compiler::ViewDrawing::make(scene, view)->draw();
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x)
            ASSERT_NEAR(drawn.pixel(x, y)[0], 0.5, 2.5 / 255) << x << ", " << y;
}

/// Each of the squares lies a little below and to the right of the one before, so that it begins with its
/// upper side, and ends with its lower one, in a step in which thousands are cut.
TEST(DrawnOnce, LevelSidesInLevelStepsLeaveNoHoles) {
    constexpr int count = 10000;
    scene::Scene scene;
    scene.width = scene.height = 500;
    std::mt19937 random(1);
    for (int i = 0; i < count; ++i) {
        const double from = 300.0 * i / count;
        scene::Item item;
        item.path =
            std::make_shared<const scene::Path>(scene::rectangle({from, from}, {from + 200, from + 200}));
        item.paint = scene::Color{float(random() % 256) / 255, 0, 0, 1};
        scene.root.children.push_back({item});
    }
    constexpr int top = 224;
    const asset::View view{500, 32, {1, 0, 0, 1, 0, -double(top)}};
    const image::Raster drawn = compiler::ViewDrawing::make(scene, view)->draw();
    for (int y = 0; y < view.height; ++y)
        for (int x = top + y - 198; x < top + y + 198; ++x)
            ASSERT_NEAR(drawn.pixel(x, y)[3], 1, 0.5 / 255) << x << ", " << y;
}

/// Faint circles, in translucent groups of some each, or in none.
std::string faintCircles(int count, int inGroup) {
    Numbers numbers;
    std::string content;
    for (int i = 0; i < count; ++i) {
        if (inGroup > 0 && i % inGroup == 0)
            content += i % (3 * inGroup) == 0 ? "<g opacity=\".3\">" : "<g opacity=\".3\"><g opacity=\".6\">";
        content += fmt::format(
            "<circle cx=\"{:.3f}\" cy=\"{:.3f}\" r=\"{:.3f}\" fill=\"#{:06x}\" fill-opacity=\".04\"/>",
            24 + numbers.between() / 4, 24 + numbers.between() / 4, 8 + numbers.between() / 4,
            numbers.color());
        if (inGroup > 0 && i % inGroup == inGroup - 1)
            content += i / inGroup % 3 == 0 ? "</g>" : "</g></g>";
    }
    return content;
}

/// So many layers on top of each other that a tree of them tells what they show.
TEST(DrawnOnce, DeepStacksLookAsCompiledOnes) {
    EXPECT_TRUE(compareDrawings(sceneOf(faintCircles(160, 0)), "circles"));
    EXPECT_TRUE(compareDrawings(sceneOf(faintCircles(120, 4)), "circles in groups"));
}

/// Lines of a grid, as many as steps fall on, or on what is between them: black ones below red ones.
TEST(DrawnOnce, GridsOfManyLinesAreTheirMeans) {
    constexpr int across = 100;  // lines to a pixel
    constexpr double share = 0.4;
    scene::Scene scene;
    scene.width = scene.height = 64;
    const auto add = [&](double from, bool isUpright, std::size_t number) {
        const double to = from + share / across, side = 64;
        scene::Item item;
        item.path = std::make_shared<const scene::Path>(isUpright ? scene::rectangle({from, 0}, {to, side})
                                                                  : scene::rectangle({0, from}, {side, to}));
        const float shade = float(number % 5) / 255;  // each is a layer of its own
        item.paint = isUpright ? scene::Color{1, shade, 0, 1} : scene::Color{0, shade, 0, 1};
        scene.root.children.push_back({item});
    };
    for (const bool isUpright : {false, true})
        for (int i = 0; i < 64 * across; ++i)
            add((i + 0.1) / across, isUpright, std::size_t(i));
    const asset::View view{64, 24, {1, 0, 0, 1, 0, -20}};
    const image::Raster drawn = compiler::ViewDrawing::make(scene, view)->draw();
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            ASSERT_NEAR(drawn.pixel(x, y)[0], share, 2.0 / 255) << x << ", " << y;
            ASSERT_NEAR(drawn.pixel(x, y)[3], 1 - (1 - share) * (1 - share), 2.0 / 255) << x << ", " << y;
        }
}

/// One outline: upright bars that touch, and far below the top level ones, thirty to a pixel. There y is so
/// large that part of a row, added to it, may be rounded away.
TEST(DrawnOnce, BarsThatTouchFarFromTheTopEnd) {
    constexpr double side = 64, bottom = 500, from = 480;
    constexpr int upright = 100, level = 30;  // to a pixel
    scene::Path path;
    const auto add = [&](scene::Point min, scene::Point max) {
        const scene::Path bar = scene::rectangle(min, max);
        path.insert(path.end(), bar.begin(), bar.end());
    };
    for (int i = 0; i < int(bottom - from) * level; ++i)
        add({0, from + double(i) / level}, {side, from + double(i + 1) / level});
    for (int i = 0; i < int(side) * upright; ++i)
        add({double(i) / upright, 0}, {double(i + 1) / upright, bottom});
    scene::Scene scene;
    scene.width = side;
    scene.height = bottom;
    scene::Item item;
    item.path = std::make_shared<const scene::Path>(std::move(path));
    item.paint = scene::Color{1, 0, 0, 1};
    scene.root.children.push_back({item});
    const asset::View view{int(side), int(bottom)};
    const image::Raster drawn = compiler::ViewDrawing::make(scene, view)->draw();
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x)
            ASSERT_NEAR(drawn.pixel(x, y)[3], 1, 0.5 / 255) << x << ", " << y;
}

TEST(DrawnOnce, DenseStripsDoNotDependOnEachOther) {
    for (const std::string& content :
         {crossingLines(16000, "nonzero") + stackedCircles(500), gradientStrokes(400, "stroke-width:2"),
          faintCircles(1200, 0), faintCircles(800, 4)}) {
        const scene::Scene scene = sceneOf(content);
        const auto drawing = compiler::ViewDrawing::make(scene, wholePicture(scene, 100));
        ASSERT_TRUE(drawing);
        const image::Raster all = drawing->draw();
        for (int first = 0; first < drawing->height(); first += 70)
            drawing->scan(first, std::min(first + 70, drawing->height()),
                          [&](int y, const asset::ColorRun& run) {
                              for (int x = run.first; x < run.end; ++x)
                                  for (int c = 0; c < 4; ++c)
                                      ASSERT_EQ(all.pixel(x, y)[c], std::clamp(run.color[c], 0.0f, 1.0f));
                          });
    }
}

/// Operations that jump where colours nearly vanish are left out: there any two drawings differ.
constexpr const char* filterOperations[]{
    "<feGaussianBlur stdDeviation='3 1'/>",
    "<feDropShadow dx='4.3' dy='2' stdDeviation='2' flood-color='#204080'/>",
    "<feOffset dx='3.3' dy='-2.7'/><feMerge><feMergeNode/><feMergeNode in='SourceGraphic'/></feMerge>",
    "<feColorMatrix type='saturate' values='.3'/>",
    "<feMorphology operator='dilate' radius='2'/>",
    "<feTurbulence baseFrequency='.05'/><feComposite in2='SourceGraphic' operator='in'/>",
    "<feFlood flood-color='#fa0' x='20' y='10' width='8' height='6'/><feTile/><feBlend in2='SourceGraphic' "
    "mode='multiply'/>",
    "<feImage href='#seen'/><feComposite in2='SourceAlpha' operator='arithmetic' k2='.5' k3='.5'/>",
};

scene::Scene filteredScene(const std::string& operations) {
    return sceneOf(fmt::format(
        "<defs><linearGradient id='g'><stop stop-color='#e33'/><stop offset='1' "
        "stop-color='#23c'/></linearGradient>"
        "<circle id='seen' cx='30' cy='25' r='14' fill='url(#g)'/>"
        "<clipPath id='c'><circle cx='50' cy='50' r='41'/></clipPath>"
        "<mask id='m'><rect width='100' height='100' fill='url(#g)'/></mask>"
        "<filter id='f' filterUnits='userSpaceOnUse' x='5' y='5' width='91' height='88'>{}</filter></defs>"
        "<rect x='8' y='60' width='84' height='30' fill='#f4d58d'/>"
        "<g filter='url(#f)'><path d='M20,22H50V70H20Z' fill='#2e8b57'/><path d='M50,22H78L70,70H50Z' "
        "fill='url(#g)'/></g>"
        "<g clip-path='url(#c)' opacity='.7'><g filter='url(#f)' transform='rotate(20 50 50)'>"
        "<circle cx='56' cy='52' r='17' fill='#fff' stroke='#30204a' stroke-width='4'/></g><path "
        "d='M6,94L40,80L94,94Z'/></g>"
        "<g mask='url(#m)' style='mix-blend-mode:multiply'><g filter='url(#f)'><rect x='60' y='8' width='22' "
        "height='50' fill='#8a3'/>"
        "</g></g>",
        operations));
}

TEST(DrawnOnce, FilteredScenesLookAsCompiledOnes) {
    for (const char* operations : filterOperations) {
        const scene::Scene scene = filteredScene(operations);
        compiler::Options options;
        options.tolerance /= 4;
        const asset::Asset asset = compiler::compile(scene, options).asset;
        const asset::Evaluator evaluator(asset);
        for (const Looked& looked : views) {
            const asset::View view = viewOf(scene, looked);
            const auto drawing = compiler::ViewDrawing::make(scene, view);
            ASSERT_TRUE(drawing) << operations;
            const compare::Difference d = compare::compare(drawing->draw(), evaluator.draw(view));
            EXPECT_LE(d.max, mostApart)
                << operations << ", " << looked.name << " at " << d.worstX << ", " << d.worstY;
            EXPECT_LE(d.rms, rmsApart) << operations << ", " << looked.name;
        }
    }
}

TEST(DrawnOnce, FilteredScenesGiveTheSameRowsEachTime) {
    const scene::Scene scene = filteredScene(filterOperations[0]);
    const auto drawing = compiler::ViewDrawing::make(scene, wholePicture(scene, 150));
    ASSERT_TRUE(drawing);
    const image::Raster all = drawing->draw();
    int pixels = 0;
    for (const int first : {0, 70, 30})
        drawing->scan(first, first + 30, [&](int y, const asset::ColorRun& run) {
            ASSERT_TRUE(y >= first && y < first + 30);
            for (int x = run.first; x < run.end; ++x, ++pixels)
                for (int c = 0; c < 4; ++c)
                    ASSERT_EQ(all.pixel(x, y)[c], run.color[c]);
        });
    EXPECT_EQ(pixels, 3 * 30 * 150);
}

// ---- Patterns ---------------------------------------------------------------------------------------

/// What tiles may hold: shapes that end in them, reach beyond them or run through them, in groups, clips,
/// masks and tiles.
constexpr const char* tileContents[]{
    "<circle cx='4' cy='3' r='2.5' fill='#268'/>",
    "<rect width='8' height='6' fill='#fed'/><path d='M0,3H8' stroke='#246' stroke-width='.7'/>",
    "<path d='M-3,-2L20,13M9,-4L-9,14' stroke='#a24' stroke-width='1.3' stroke-opacity='.6'/>",
    "<path fill-rule='evenodd' d='M-2,1L10,4 3,-3 2,9 9,-1Z' fill='#382'/><circle r='2'/>",
    "<g opacity='.5'><rect x='-1' y='2' width='7' height='9' fill='#c40'/><circle cx='5' cy='4' r='2'/></g>",
    "<clipPath id='c'><circle cx='6' cy='3' r='3'/></clipPath>"
    "<g clip-path='url(#c)'><path d='M0,0H8V6H0Z' fill='#06c'/><path d='M0,0L8,6' stroke='#fff'/></g>",
    "<mask id='m'><rect x='2' y='1' width='5' height='9' fill='#999'/></mask>"
    "<g mask='url(#m)'><circle cx='4' cy='3' r='4' fill='#808'/></g>",
    "<pattern id='q' width='1.1' height='.9' patternUnits='userSpaceOnUse' patternTransform='rotate(30)'>"
    "<circle cx='.5' cy='.4' r='.3' fill='#b30'/></pattern><circle cx='5' cy='3' r='4' fill='url(#q)'/>"};

TEST(DrawnOnce, PatternsLookAsCompiledOnes) {
    for (const char* content : tileContents)
        for (const char* transform : {"", "rotate(25)", "matrix(1 .3 -.4 -.8 3 5)"}) {
            const std::string fill = fmt::format(
                "<pattern id='p' width='8' height='6' patternUnits='userSpaceOnUse' patternTransform='{}'>{}"
                "</pattern><circle cx='20' cy='30' r='24' fill='url(#p)' opacity='.8'/>"
                "<path d='M30,60L60,5L50,40Z' fill='url(#p)' stroke='#000'/>"
                "<rect x='45' y='45' width='30' height='12' fill='url(#p)'/>",
                transform, content);
            EXPECT_TRUE(compareDrawings(sceneOf(fill), fmt::format("{} {}", content, transform)));
        }
}

/// More tiles than are made one by one.
TEST(DrawnOnce, ManyFillsOfPatternsAreAllDrawn) {
    constexpr int across = 64;
    std::string content = "<pattern id='p' width='.1' height='.1'><rect width='.05' height='1'/></pattern>";
    for (int i = 0; i < across * across; ++i)
        content +=
            fmt::format("<rect x='{}' y='{}' width='1' height='1' fill='url(#p)'/>", i % across, i / across);
    const scene::Scene scene = sceneOf(content);
    const auto drawing = compiler::ViewDrawing::make(scene, wholePicture(scene, 64));
    ASSERT_TRUE(drawing);
    EXPECT_TRUE(drawing->warnings().empty());
    const image::Raster drawn = drawing->draw();
    double sum = 0;
    for (int y = 0; y < drawn.height; ++y)
        for (int x = 0; x < drawn.width; ++x)
            sum += drawn.pixel(x, y)[3];
    EXPECT_NEAR(sum / (64 * 64), 0.5, 0.5 / 255);
}

/// A layer of its outline is left, which nothing paints or clips with.
TEST(DrawnOnce, PatternsBesideTheViewShowNothing) {
    const scene::Scene scene = sceneOf(
        "<pattern id='p' width='9' height='9' patternUnits='userSpaceOnUse'><circle r='3'/></pattern>"
        "<circle cx='30' cy='30' r='9'/><circle cx='-400' cy='30' r='40' fill='url(#p)'/>");
    EXPECT_TRUE(compareDrawings(scene, "beside"));
}

/// A filter in a pattern is an image; a pattern of many tiles of gradients under a filter is compiled.
TEST(DrawnOnce, FiltersInPatternsAreDrawnAndManyTilesOfGradientsAreNot) {
    const auto patternOf = [](double side, const char* inside, const char* outside) {
        return sceneOf(fmt::format(
            "<filter id='f'><feGaussianBlur stdDeviation='.5'/></filter><linearGradient id='g'><stop/>"
            "<stop offset='1' stop-color='red'/></linearGradient><pattern id='p' width='{0}' "
            "height='{0}' patternUnits='userSpaceOnUse'><circle r='{0}' fill='url(#g)' {1}/></pattern>"
            "<rect width='100' height='100' fill='url(#p)' {2}/>",
            side, inside, outside));
    };
    const scene::Scene inside = patternOf(20, "filter='url(#f)'", ""),
                       outside = patternOf(0.5, "", "filter='url(#f)'");
    EXPECT_TRUE(compiler::ViewDrawing::make(inside, wholePicture(inside, 100)));
    EXPECT_FALSE(compiler::ViewDrawing::make(outside, wholePicture(outside, 100)));
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
