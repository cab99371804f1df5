// The C API: what fails says so, and nothing is thrown.
#include <array>
#include <climits>
#include <cmath>
#include <cstring>
#include <string>

#include <gtest/gtest.h>

#include <vtm/vtm.h>

namespace {

constexpr char redAndBlue[] =
    R"(<svg xmlns="http://www.w3.org/2000/svg" width="4" height="2"><rect width="2" height="2" fill="red"/>)"
    R"(<rect x="2" width="2" height="2" fill="blue"/><foreignObject>left out</foreignObject></svg>)";

class CApi : public testing::Test {
protected:
    ~CApi() override { vtmDestroyPicture(picture_); }
    /// The first row's reds.
    std::string reds(const VtmRenderOptions& options) {
        VtmImage* image = vtmRenderPicture(picture_, &options);
        std::string found;
        for (int x = 0; image && x < vtmImageWidth(image); ++x)
            found += vtmImagePixels(image)[4 * x] == 255 ? 'r' : '.';
        vtmDestroyImage(image);
        return found;
    }
    bool refuses(const VtmRenderOptions& options, const char* word) {
        VtmImage* image = vtmRenderPicture(picture_, &options);
        vtmDestroyImage(image);
        return !image && std::strstr(vtmGetError(), word);
    }
    VtmPicture* picture_ = vtmLoadPictureFromMemory(redAndBlue, sizeof redAndBlue - 1, "memory.svg");
};

TEST_F(CApi, ZeroOptionsDrawAPixelAUnit) {
    ASSERT_TRUE(picture_);
    EXPECT_EQ(vtmPictureWidth(picture_), 4);
    EXPECT_EQ(vtmPictureHeight(picture_), 2);
    EXPECT_EQ(reds({}), "rr..");
    VtmImage* image = vtmRenderPicture(picture_, nullptr);
    ASSERT_TRUE(image);
    EXPECT_EQ(vtmImageHeight(image), 2);
    vtmDestroyImage(image);
}

/// The width of the area that a text covers, in pixels, and the only warning if there is one.
struct Drawn {
    int width = 0;
    std::string warning;
};

Drawn drawnText(const VtmLoadOptions& options) {
    static constexpr char text[] = R"(<svg xmlns="http://www.w3.org/2000/svg" width="1in" height="40">)"
                                   R"(<text y="30">H</text></svg>)";
    VtmPicture* picture = vtmLoadPictureFromMemoryWithOptions(text, sizeof text - 1, &options);
    VtmImage* image = vtmRenderPicture(picture, nullptr);
    Drawn drawn;
    for (int x = 0; image && x < vtmImageWidth(image); ++x)
        for (int y = 0; y < vtmImageHeight(image); ++y)
            if (vtmImagePixels(image)[4 * (y * vtmImageWidth(image) + x) + 3] > 127)
                drawn.width = x + 1;
    if (vtmPictureWarningCount(picture) == 1) {
        char warning[256];
        vtmGetPictureWarning(picture, 0, warning, sizeof warning);
        drawn.warning = warning;
    }
    vtmDestroyImage(image);
    vtmDestroyPicture(picture);
    return drawn;
}

TEST(CApiFonts, OptionsReachTheLibrary) {
    const char* directories[] = {"/usr/share/fonts/truetype/dejavu", nullptr};
    VtmLoadOptions options = {};
    options.fontDirectories = directories;
    options.noSystemFonts = 1;
    options.defaultFamily = "DejaVu Sans";
    options.defaultFontSize = 20;
    const int narrow = drawnText(options).width;
    EXPECT_NEAR(narrow, 14, 2);  // an H is .65 ems wide, with space beside it
    options.defaultFontSize = 40;
    EXPECT_NEAR(drawnText(options).width, 2 * narrow, 2);
    options.defaultFamily = "DejaVu Sans Mono";
    EXPECT_LT(drawnText(options).width, 2 * narrow - 2);
    options.name = "some.svg";
    options.fontDirectories = nullptr;
    EXPECT_EQ(drawnText(options).warning, "some.svg:1:66: <text>: there are no fonts; it is left out");
}

TEST(CApiFonts, OptionsOutOfRangeAreErrors) {
    VtmLoadOptions options = {};
    options.dpi = -1;
    EXPECT_FALSE(vtmLoadPictureFromMemoryWithOptions(redAndBlue, sizeof redAndBlue - 1, &options));
    EXPECT_NE(std::string(vtmGetError()).find("dpi"), std::string::npos);
    EXPECT_FALSE(vtmLoadPictureWithOptions("missing.svg", nullptr));
}

TEST_F(CApi, OptionsReachTheLibrary) {
    VtmRenderOptions options = {};
    options.rotation = 180;
    EXPECT_EQ(reds(options), "..rr");
    options = {};
    options.view[0] = 1, options.view[2] = 2, options.view[3] = 2;
    EXPECT_EQ(reds(options), "r.");
    options = {};
    options.scale = 2;
    EXPECT_EQ(reds(options), "rrrr....");
    options = {};
    options.width = 2, options.height = 2, options.fit = VTM_FIT_COVER;
    EXPECT_EQ(reds(options), "r.");
    options.matrix[0] = -1, options.matrix[3] = 1, options.matrix[4] = 3, options.fit = VTM_FIT_CONTAIN;
    EXPECT_EQ(reds(options), ".r");
    options.background[0] = options.background[3] = 1;
    options.matrix[4] = 0;  // all of the picture lies on the left of the raster
    EXPECT_EQ(reds(options), "rr");
}

TEST_F(CApi, WarningsAreCopiedAndCut) {
    ASSERT_EQ(vtmPictureWarningCount(picture_), 1u);
    std::array<char, 11> text{};
    const std::size_t length = vtmGetPictureWarning(picture_, 0, text.data(), text.size());
    EXPECT_GT(length, text.size());
    EXPECT_STREQ(text.data(), "memory.svg");
    EXPECT_EQ(vtmGetPictureWarning(picture_, 0, nullptr, 0), length);
    EXPECT_EQ(vtmGetPictureWarning(picture_, 1, text.data(), text.size()), 0u);
}

TEST_F(CApi, NullIsAnErrorNeverACrash) {
    EXPECT_EQ(vtmLoadPicture(nullptr), nullptr);
    EXPECT_EQ(vtmLoadPictureFromMemory(nullptr, 3, nullptr), nullptr);
    EXPECT_EQ(vtmLoadPictureFromMemory(nullptr, 0, nullptr), nullptr);
    EXPECT_EQ(vtmPictureWidth(nullptr), 0);
    EXPECT_EQ(vtmPictureWarningCount(nullptr), 0u);
    EXPECT_EQ(vtmGetPictureWarning(nullptr, 0, nullptr, 0), 0u);
    EXPECT_EQ(vtmRenderPicture(nullptr, nullptr), nullptr);
    EXPECT_STREQ(vtmGetError(), "the picture is NULL");
    EXPECT_EQ(vtmSavePicture(nullptr, "a"), 0);
    EXPECT_EQ(vtmSavePicture(picture_, nullptr), 0);
    EXPECT_EQ(vtmImagePixels(nullptr), nullptr);
    EXPECT_EQ(vtmImageWidth(nullptr), 0);
    EXPECT_EQ(vtmSaveImage(nullptr, "a.png"), 0);
    EXPECT_STREQ(vtmGetError(), "the image is NULL");
    vtmDestroyImage(nullptr);
    vtmDestroyPicture(nullptr);
}

TEST_F(CApi, ErrorsSayWhy) {
    EXPECT_EQ(vtmLoadPicture("no such file.svg"), nullptr);
    EXPECT_TRUE(std::strstr(vtmGetError(), "no such file.svg")) << vtmGetError();
    VtmRenderOptions options = {};
    options.width = -1;
    EXPECT_TRUE(refuses(options, "width"));
    options.width = INT_MAX;
    EXPECT_TRUE(refuses(options, "pixels"));
    options = {};
    options.scale = std::nan("");
    EXPECT_TRUE(refuses(options, "scale"));
    options = {};
    options.fit = 7;
    EXPECT_TRUE(refuses(options, "fit"));
    options = {};
    options.engine = -1;
    EXPECT_TRUE(refuses(options, "engine"));
}

}  // namespace
