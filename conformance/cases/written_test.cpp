// Scenes written as SVG and as trees, and read again: the same pictures, and from then on the same text.
// VTM_TEST_ALL=1 takes all files and many more random scenes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <vtm/compiler/compile.hpp>
#include <vtm/compiler/view.hpp>
#include <vtm/image/codec.hpp>
#include <vtm/raster/evaluate.hpp>
#include <vtm/svg/load.hpp>
#include <vtm/svg/write.hpp>
#include <vtm/vtmtree.hpp>
#include "conformance/cases/support.hpp"
#include "conformance/generate/generate.hpp"

namespace vtm::cases {
namespace {

namespace fs = std::filesystem;

constexpr int side = 64;  ///< pixels, of the square to which scenes are stretched, for some are very narrow
constexpr double bound = 1;      ///< 1/255
constexpr double maxSize = 1e9;  ///< user units, of documents that load() takes
constexpr std::size_t maxBytes =
    2'000'000;  ///< of a document, unless all are taken: what takes seconds is left out

bool takesAll() { return std::getenv("VTM_TEST_ALL") != nullptr; }

svg::Document read(const std::string& text) {
    return svg::load({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

image::Raster drawn(const scene::Scene& scene, asset::Mode mode) {
    compiler::Options options;
    options.mode = mode;
    const scene::Frame frame = scene::frame(
        {.width = side, .height = side, .placement = {scene::Fit::Stretch}}, scene.width, scene.height);
    return asset::evaluate(compiler::compile(scene, options).asset, compiler::viewOf(frame));
}

/// Between premultiplied channels, in 1/255.
double difference(const image::Raster& a, const image::Raster& b) {
    double most = a.rgba.size() == b.rgba.size() ? 0 : INFINITY;
    for (std::size_t i = 0; i < std::min(a.rgba.size(), b.rgba.size()); ++i)
        most = std::max(most, 255.0 * std::abs(a.rgba[i] - b.rgba[i]));
    return most;
}

void expectSamePictures(const scene::Scene& scene, const scene::Scene& again) {
    for (const asset::Mode mode : {asset::Mode::Exact, asset::Mode::Compat}) {
        image::Raster expected;
        try {
            expected = drawn(scene, mode);
        } catch (const compiler::LimitError&) {
            continue;
        }
        EXPECT_LE(difference(expected, drawn(again, mode)), bound)
            << (mode == asset::Mode::Exact ? "exact" : "compat");
    }
}

/// What the importer made is written at once as it is written ever after.
void expectReadsBack(const scene::Scene& scene, bool isImported) {
    const std::string text = svg::write(scene);
    const svg::Document again = read(text);
    // A few random scenes reach further than the importer takes.
    const bool isCut = !again.warnings.empty() && again.warnings[0].kind == svg::Warning::Kind::Limit;
    if (!again.warnings.empty() && (isImported || !isCut))
        ADD_FAILURE() << again.warnings[0].message;
    const std::string second = svg::write(again.scene);
    EXPECT_TRUE(second == text || !isImported);
    EXPECT_TRUE(svg::write(read(second).scene) == second);
    if (!isCut)
        expectSamePictures(scene, again.scene);
}

Tree readAsTree(const std::string& text) {
    return readTree({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

bool hasFilter(const scene::Group& group) {
    return group.filter || std::any_of(group.children.begin(), group.children.end(), [](const auto& node) {
               const auto* child = std::get_if<scene::Group>(&node.value);
               return child && hasFilter(*child);
           });
}

/// As a tree of VTMs. What was read once stays as it is; so does what the importer made, at once.
void expectReadsBackAsTree(const scene::Scene& scene, bool isImported) {
    const Tree tree{scene.width, scene.height, Vtm::fromScene(scene)};
    if (hasFilter(scene.root)) {
        EXPECT_THROW(writeTree(tree), TreeError);  // docs/vtmtree.md
        return;
    }
    const std::string made = writeTree(tree);
    const Tree again = readAsTree(made);
    const std::string text = writeTree(again);
    EXPECT_TRUE(text == made || !isImported);
    const Tree third = readAsTree(text);
    EXPECT_TRUE(scene::dump(third.toScene()) == scene::dump(again.toScene()));
    EXPECT_TRUE(writeTree(third) == text);
    if (!isImported)
        expectSamePictures(scene, again.toScene());
}

std::vector<fs::path> svgFiles(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".svg" && (takesAll() || entry.file_size() <= maxBytes))
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

/// A part of what is read back: by default the first alone.
class WrittenPart : public testing::TestWithParam<std::size_t> {
protected:
    static void expectFilesReadBack(const fs::path& folder) {
        if (!fs::exists(folder))
            GTEST_SKIP() << folder << " is absent";
        const std::vector<fs::path> files = svgFiles(folder);
        for (std::size_t i = GetParam(); i < files.size(); i += parts) {
            SCOPED_TRACE(files[i].string());
            const scene::Scene scene = loadScene(files[i]);
            expectReadsBack(scene, true);
            expectReadsBackAsTree(scene, true);
        }
    }

public:
    static constexpr std::size_t parts = 16;
};

TEST_P(WrittenPart, OfTheSuiteReadsBack) { expectFilesReadBack(sharedDirectory() / "svg-suite" / "tests"); }

TEST_P(WrittenPart, OfTheCorpusReadsBack) { expectFilesReadBack(sharedDirectory() / "corpus"); }

// ---- Random scenes -----------------------------------------------------------------------------------

void round(scene::Color& color) {
    for (float* channel : {&color.r, &color.g, &color.b})
        *channel = std::round(*channel * 255) / 255;
}

/// The same with colours that SVG can say.
void round(scene::Group& group) {
    for (scene::Node& node : group.children)
        if (auto* child = std::get_if<scene::Group>(&node.value))
            round(*child);
        else if (auto* item = std::get_if<scene::Item>(&node.value))
            std::visit(
                [](auto& paint) {
                    if constexpr (requires { paint.stops; })
                        for (scene::GradientStop& stop : paint.stops)
                            round(stop.color);
                    else if constexpr (requires { paint.r; })
                        round(paint);
                },
                item->paint);
}

void expectReadsBackRounded(scene::Scene scene) {
    round(scene.root);
    expectReadsBack(scene, false);
}

TEST_P(WrittenPart, OfRandomScenesReadsBack) {
    constexpr std::uint64_t count = 25;
    for (std::uint64_t seed = count * GetParam(); seed < count * (GetParam() + 1); ++seed) {
        SCOPED_TRACE(seed);
        expectReadsBackRounded(generate::randomScene(seed));
        expectReadsBackAsTree(generate::randomScene(seed), false);
    }
}

INSTANTIATE_TEST_SUITE_P(Of, WrittenPart,
                         testing::Range(std::size_t{0}, takesAll() ? WrittenPart::parts : std::size_t{1}));

TEST(Written, HardScenesReadBack) {
    for (const generate::Family& family : generate::hardFamilies())
        for (std::uint64_t seed = 0; seed < (takesAll() ? 20u : 1u); ++seed) {
            SCOPED_TRACE(std::string(family.name) + " " + std::to_string(seed));
            const scene::Scene scene = family.make(seed);
            expectReadsBackAsTree(scene, false);
            if (std::max(scene.width, scene.height) <= maxSize)
                expectReadsBackRounded(scene);
            else
                EXPECT_THROW(read(svg::write(scene)), svg::ParseError);
        }
}

// ---- What only authors make --------------------------------------------------------------------------

scene::Node filled(const scene::Path& path, scene::Paint paint) {
    return {scene::Item{std::make_shared<const scene::Path>(path), scene::identity, scene::FillRule::EvenOdd,
                        std::move(paint)}};
}

std::shared_ptr<const scene::Group> groupOf(scene::Node node) {
    auto group = std::make_shared<scene::Group>();
    group->children.push_back(std::move(node));
    return group;
}

const scene::Path whole = scene::rectangle({0, 0}, {40, 30});
const scene::Path star = scene::polygon({{20, 2}, {31, 27}, {3, 11}, {37, 12}, {8, 28}});

scene::Scene sceneOf(std::vector<scene::Node> nodes) {
    scene::Scene scene{40, 30, {}};
    scene.root.children = std::move(nodes);
    return scene;
}

std::vector<scene::Shape> masks() {
    scene::StrokeStyle wide;
    wide.width = 2;
    wide.join = scene::Join::Round;
    const auto path = std::make_shared<const scene::Path>(star);
    const scene::Affine turned{0.9, 0.3, -0.3, 0.9, 2, -3};
    return {{path, scene::identity, scene::FillRule::NonZero},
            {path, turned, scene::FillRule::EvenOdd},
            {path, turned, wide}};
}

TEST(Written, SelectionsReadBack) {
    const auto red = groupOf(filled(whole, scene::Color{1, 0, 0, 1})),
               blue = groupOf(filled(whole, scene::Color{0, 0, 1, 0.4f}));
    const scene::Node ground = filled(whole, scene::Color{1, 1, 0, 1});
    for (const scene::Shape& mask : masks())
        for (const auto& [inside, outside] :
             {std::pair(red, blue), std::pair(blue, red), {blue, {}}, {{}, blue}}) {
            SCOPED_TRACE(mask.geometry.index());
            expectReadsBack(sceneOf({ground, {scene::Select{mask, inside, outside}}}), false);
            expectReadsBack(sceneOf({{scene::Select{mask, inside, outside}}}), false);
        }
}

TEST(Written, SelectionsOfSelectionsReadBack) {
    auto picture = groupOf(filled(whole, scene::Color{1, 1, 0, 1}));
    for (const scene::Shape& mask : masks()) {
        const auto inside = groupOf(filled(whole, scene::Color{0, float(mask.geometry.index()), 1, 0.5f}));
        picture = groupOf({scene::Select{mask, inside, picture}});
    }
    expectReadsBack(sceneOf(std::vector<scene::Node>(picture->children.begin(), picture->children.end())),
                    false);
}

TEST(Written, OutlinesPaintedWithImagesReadBack) {
    auto bitmap = std::make_shared<image::Bitmap>();
    bitmap->width = 40;
    bitmap->height = 30;
    for (int i = 0; i < 1200; ++i)
        for (const int channel : {i * 37 % 256, i * 91 % 256, 200, i % 3 ? 255 : 100})
            bitmap->rgba.push_back(static_cast<std::uint8_t>(channel));
    scene::Item item = std::get<scene::Item>(filled(star, scene::ImagePaint{bitmap}).value);
    for (const scene::Shape& mask : masks()) {
        item.geometry = mask.geometry;
        item.transform = mask.transform;
        SCOPED_TRACE(mask.geometry.index());
        expectReadsBack(sceneOf({{item}}), false);
    }
    item =
        std::get<scene::Item>(filled(scene::rectangle({0, 3}, {40, 20.5}), scene::ImagePaint{bitmap}).value);
    item.transform = scene::Affine{0.9, 0, 0, 1.1, 2.3, -3.1};
    expectReadsBack(sceneOf({{item}}), false);
    // As glyphs that are bitmaps: in units of the font, ending with the bitmap but for rounding.
    scene::ImagePaint paint{bitmap};
    paint.transform = scene::Affine{1 / 0.3, 0, 0, 1 / 0.7, 0.1, -33.3};
    const scene::Point corner(0.1, -33.3), size(40 / 0.3, 30 / 0.7);
    item = std::get<scene::Item>(filled(scene::rectangle(corner, corner + size), paint).value);
    item.transform = scene::Affine{0.113, 0, 0, 0.517, 4.7, 30.1};
    expectReadsBack(sceneOf({{item}}), false);
}

}  // namespace
}  // namespace vtm::cases
