#include <vtm/image/codec.hpp>

#include <filesystem>
#include <fstream>

#include <sys/stat.h>

#include "svg/geometry/path_geometry.hpp"
#include "svg/tests/support.hpp"
#include "svg/xml/resource.hpp"
#include "tests/test_folder.hpp"

namespace vtm::svg {
namespace {

std::string base64(std::span<const std::uint8_t> bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
        for (int k = 3; k >= 0; --k)
            text += digits[group >> 6 * k & 63];
    }
    for (std::size_t k = 0; k < (3 - bytes.size() % 3) % 3; ++k)
        text[text.size() - 1 - k] = '=';
    return text;
}

/// 4 x 2 red pixels.
std::string pngUrl() {
    image::Bitmap bitmap{4, 2, {}};
    for (int i = 0; i < 8; ++i)
        bitmap.rgba.insert(bitmap.rgba.end(), {255, 0, 0, 255});
    return "data:image/png;base64," + base64(image::encodePng(bitmap));
}
scene::Item imageItem(const std::string& attributes) {
    return itemOf("<image href='" + pngUrl() + "' " + attributes + "/>");
}
Box boxOf(const scene::Item& item) { return boundingBox(*item.path, item.transform); }

TEST(DataUrl, Base64) {
    const auto bytes = decodeDataUrl("data:;base64,aGVs\n bG8=");
    EXPECT_EQ(std::string(bytes.begin(), bytes.end()), "hello");
}
TEST(DataUrl, Plain) {
    const auto bytes = decodeDataUrl("data:text/plain,a%20b%zz");
    EXPECT_EQ(std::string(bytes.begin(), bytes.end()), "a b%zz");
}
TEST(DataUrl, MalformedOnesAreErrors) {
    EXPECT_THROW(decodeDataUrl("data:;base64,a*b"), image::CodecError);
    EXPECT_THROW(decodeDataUrl("data:nothing"), image::CodecError);
}

TEST(Image, HasItsOwnSizeByDefault) {
    expectNear(boxOf(imageItem("x='1' y='2'")).max, {5, 4});
    expectNear(boxOf(imageItem("width='8'")).max, {8, 4});
}
TEST(Image, MeetsItsViewport) {
    const Box box = boxOf(imageItem("width='10' height='10'"));
    expectNear(box.min, {0, 2.5});
    expectNear(box.max, {10, 7.5});
}
TEST(Image, SliceIsCutToTheViewport) {
    const scene::Item item = imageItem("width='10' height='10' preserveAspectRatio='xMinYMin slice'");
    expectNear(boxOf(item).max, {10, 10});
    expectNear(item.transform, {5, 0, 0, 5, 0, 0});
}
TEST(Image, RenderingChoosesTheFilter) {
    const auto filter = [](const std::string& attributes) {
        return std::get<scene::ImagePaint>(imageItem(attributes).paint).filter;
    };
    EXPECT_EQ(filter(""), scene::ImageFilter::Trilinear);
    EXPECT_EQ(filter("image-rendering='optimizeQuality'"), scene::ImageFilter::Trilinear);
    EXPECT_EQ(filter("style='image-rendering:smooth'"), scene::ImageFilter::Trilinear);
    EXPECT_EQ(filter("style='image-rendering:high-quality'"), scene::ImageFilter::Bicubic);
    EXPECT_EQ(filter("style='image-rendering:crisp-edges'"), scene::ImageFilter::Nearest);
    EXPECT_EQ(filter("image-rendering='optimizeSpeed'"), scene::ImageFilter::Nearest);
    EXPECT_EQ(filter("style='image-rendering:pixelated'"), scene::ImageFilter::Nearest);
}
TEST(Image, BitmapsAreShared) {
    const std::string image = "<image href='" + pngUrl() + "'/>";
    const auto items = itemsOf(loadBody(image + image));
    ASSERT_EQ(items.size(), 2u);
    EXPECT_EQ(std::get<scene::ImagePaint>(items[0].paint).bitmap,
              std::get<scene::ImagePaint>(items[1].paint).bitmap);
}
TEST(Image, NestedDocumentsBecomePartOfTheScene) {
    const scene::Item item = itemOf(
        "<image x='10' width='20' height='20' href=\"data:image/svg+xml,"
        "<svg xmlns='http://www.w3.org/2000/svg' width='10' height='10'>"
        "<rect width='5' height='5' fill='lime'/></svg>\"/>");
    expectNear(item.transform, {2, 0, 0, 2, 10, 0});
    EXPECT_EQ(rgbOf(item.paint), 0x00ff00);
}
TEST(Image, NestedDocumentsAreClippedToTheirViewport) {
    EXPECT_TRUE(groupOf("<image width='20' height='20' href=\"data:image/svg+xml,"
                        "<svg xmlns='http://www.w3.org/2000/svg' width='10' height='10'>"
                        "<rect width='50' height='5'/></svg>\"/>")
                    .clip);
}
TEST(Image, BrokenOnesAreWarnings) {
    const Document loaded = loadBody(
        "<image href='data:image/png;base64,AAAA'/><image/>"
        "<image href=\"data:image/svg+xml,<svg\"/>");
    EXPECT_TRUE(loaded.scene.root.children.empty());
    EXPECT_EQ(loaded.warnings.size(), 3u);
}

class ImageFiles : public testing::Test {
protected:
    void SetUp() override {
        std::ofstream(folder_ / "a b.svg")
            << document("<rect width='1' height='1'/><image href='a%20b.svg'/>");
    }
    Document load(std::string_view body, bool mayRead = true) const {
        Options options;
        if (mayRead)
            options.resourceDirectory = folder_.path().string();
        return loadText(document(body), options);
    }
    const TestFolder folder_;
};

TEST_F(ImageFiles, AreReadBelowTheResourceDirectory) {
    EXPECT_EQ(itemsOf(load("<image href='a%20b.svg'/>")).size(), 1u);
}
TEST_F(ImageFiles, OutsideOfTheRootAreNotRead) {
    std::filesystem::create_directories(folder_ / "below");
    std::filesystem::create_symlink("../a b.svg", folder_ / "below" / "link.svg");
    Options options;
    options.resourceDirectory = (folder_ / "below").string();
    for (const char* href : {"../a%20b.svg", "link.svg", "../below/../a%20b.svg"}) {
        const std::string body = std::string("<image href='") + href + "'/>";
        options.resourceRoot.clear();
        EXPECT_EQ(itemsOf(loadText(document(body), options)).size(), 1u) << href;
        options.resourceRoot = folder_.path().string();
        EXPECT_EQ(itemsOf(loadText(document(body), options)).size(), 1u) << href;
        options.resourceRoot = options.resourceDirectory;
        const Document refused = loadText(document(body), options);
        EXPECT_TRUE(itemsOf(refused).empty()) << href;
        ASSERT_EQ(refused.warnings.size(), 1u) << href;
        EXPECT_NE(refused.warnings[0].message.find("outside of the folder"), std::string::npos);
    }
}
TEST_F(ImageFiles, ElementsOfOtherFilesAreUsed) {
    std::filesystem::create_directories(folder_ / "icons");
    std::ofstream(folder_ / "icons" / "sheet.svg") << document(
        "<style>.a{stroke:blue}</style><symbol id='s' viewBox='0 0 2 2'>"
        "<rect class='a' width='1' height='1'/></symbol><g id='g'><use href='leaf.svg#l'/></g>"
        "<use id='loop' href='sheet.svg#loop'/>");
    std::ofstream(folder_ / "icons" / "leaf.svg") << document("<circle id='l' r='1'/>");
    const std::string sheet = "href='icons/sheet.svg#";
    const Document symbol = load("<use fill='lime' x='10' width='20' height='20' " + sheet + "s'/>");
    ASSERT_EQ(itemsOf(symbol).size(), 2u);
    EXPECT_EQ(rgbOf(itemsOf(symbol)[0].paint), 0x00ff00);  // from the use
    EXPECT_EQ(rgbOf(itemsOf(symbol)[1].paint), 0x0000ff);  // from its own sheet
    expectNear(itemsOf(symbol)[0].transform, {10, 0, 0, 10, 10, 0});
    EXPECT_EQ(itemsOf(load("<use " + sheet + "g'/>")).size(), 1u);
    for (const char* name : {"loop", "none"}) {
        const Document bad = load("<use " + sheet + name + "'/>");
        EXPECT_TRUE(itemsOf(bad).empty()) << name;
        EXPECT_EQ(bad.warnings.size(), 1u) << name;
    }
    EXPECT_EQ(load("<use href='none.svg#s'/>").warnings.size(), 1u);
    EXPECT_TRUE(itemsOf(load("<use " + sheet + "s'/>", false)).empty());
}
TEST_F(ImageFiles, ElementsOfOtherFilesHaveBoxes) {
    std::ofstream(folder_ / "sheet.svg") << document("<g id='g'><rect x='10' width='30' height='20'/></g>");
    const Document loaded = load("<use href='sheet.svg#g' style='clip-path:inset(25%)'/>");
    const auto& group = std::get<scene::Group>(loaded.scene.root.children.at(0).value);
    ASSERT_TRUE(group.clip);
    const Box box = boundingBox(*group.clip->shapes.at(0).path, group.clip->shapes.at(0).transform);
    EXPECT_NEAR(box.min.x, 17.5, 1e-9);
    EXPECT_NEAR(box.max.y, 15, 1e-9);
}
TEST_F(ImageFiles, StyleSheetsAreImported) {
    std::ofstream(folder_ / "a.css") << "@import 'b.css'; rect { fill: lime }";
    std::ofstream(folder_ / "b.css") << "@import 'a.css'; rect { fill: red; stroke: blue }";
    const std::string body =
        "<style>@import url(\"a.css\") screen; @import url(a.css) print;</style>"
        "<rect width='1' height='1'/>";
    const auto items = itemsOf(load(body));
    ASSERT_EQ(items.size(), 2u);
    EXPECT_EQ(rgbOf(items[0].paint), 0x00ff00);
    EXPECT_EQ(rgbOf(items[1].paint), 0x0000ff);
    EXPECT_EQ(load(body).warnings.size(), 1u) << "in a circle";
    EXPECT_EQ(
        rgbOf(itemsOf(load("<style>@import 'none.css';</style><rect width='1' height='1'/>")).at(0).paint),
        0);
    EXPECT_EQ(load("<style>@import 'none.css';</style>").warnings.size(), 1u);
}
TEST_F(ImageFiles, StyleSheetsAreLinked) {
    std::ofstream(folder_ / "a.css") << "rect { fill: lime }";
    std::ofstream(folder_ / "p.css") << "rect { fill: red }";
    Options options;
    options.resourceDirectory = folder_.path().string();
    const std::string linked =
        "<?xml version='1.0'?><?xml-stylesheet type='text/css' href='a.css'?>"
        "<?xml-stylesheet href=\"p.css\" media='print'?><?xml-stylesheet href='p.css' alternate='yes'?>"
        "<?xml-stylesheet href='p.css' type='text/xsl'?><?xml-stylesheet nonsense?>";
    const Document loaded = loadText(linked + document("<rect width='1' height='1'/>"), options);
    EXPECT_EQ(rgbOf(itemsOf(loaded).at(0).paint), 0x00ff00);
    EXPECT_TRUE(loaded.warnings.empty());
}
TEST_F(ImageFiles, AreNotReadWithoutOne) {
    const Document loaded = load("<image href='a%20b.svg'/>", false);
    EXPECT_TRUE(itemsOf(loaded).empty());
    EXPECT_EQ(loaded.warnings.size(), 1u);
}
TEST_F(ImageFiles, AreNotReadByAbsolutePaths) {
    EXPECT_TRUE(itemsOf(load("<image href='" + (folder_ / "a b.svg").string() + "'/>")).empty());
    EXPECT_TRUE(itemsOf(load("<image href='file://" + (folder_ / "a b.svg").string() + "'/>")).empty());
}
TEST_F(ImageFiles, PipesAndDevicesAreWarnings) {
    ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
    std::filesystem::create_symlink("/dev/zero", folder_ / "zeros");
    EXPECT_EQ(load("<image href='pipe'/><image href='zeros'/>").warnings.size(), 2u);
}

TEST_F(ImageFiles, DirectoriesAndMissingFilesAreWarnings) {
    EXPECT_EQ(load("<image href='.'/><image href='none.png'/>").warnings.size(), 2u);
}

}  // namespace
}  // namespace vtm::svg
