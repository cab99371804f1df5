// Sections 3.6, 4, 9, 14 and 15: handles, sharing, what objects keep alive, threads, queries.

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <string>
#include <thread>

#include "api/openvg/tests/fixture.hpp"

namespace vtm::openvg::testing {

namespace {

class ContextsTest : public VgTest {};

TEST_F(ContextsTest, HandlesOfAnotherTypeAreBad) {
    const VGPath path = newPath();
    const VGImage image = newImage(VG_A_8, 1, 1);
    const VGPaint paint = vgCreatePaint();
    const VGFont font = vgCreateFont(0);
    const VGMaskLayer layer = vgCreateMaskLayer(1, 1);
    const std::array<VGHandle, 5> handles{path, image, paint, font, layer};
    for (std::size_t i = 0; i < handles.size(); ++i) {
        EXPECT_NE(handles[i], VG_INVALID_HANDLE);
        for (std::size_t k = 0; k < i; ++k)
            EXPECT_NE(handles[i], handles[k]);
        const auto expected = [&](VGHandle right) {
            return right == handles[i] ? VG_NO_ERROR : VG_BAD_HANDLE_ERROR;
        };
        EXPECT_VG_ERROR(expected(path), vgGetPathCapabilities(handles[i]));
        EXPECT_VG_ERROR(expected(image), vgGetParent(handles[i]));
        EXPECT_VG_ERROR(expected(paint), vgGetColor(handles[i]));
        EXPECT_VG_ERROR(expected(layer), vgFillMaskLayer(handles[i], 0, 0, 1, 1, 0));
        if (font != handles[i])
            EXPECT_VG_ERROR(VG_BAD_HANDLE_ERROR, vgClearGlyph(handles[i], 0));
    }
    vgDestroyPath(path);
    EXPECT_VG_ERROR(VG_BAD_HANDLE_ERROR, vgGetPathCapabilities(path));
    EXPECT_VG_ERROR(VG_BAD_HANDLE_ERROR, vgDestroyPath(path));
    EXPECT_NE(newPath(), path) << "a number is not soon given again";
}

TEST_F(ContextsTest, SharedContextsShareObjectsAndNothingElse) {
    VtmContext* const friendly = vtmCreateContext(context);
    VtmContext* const stranger = vtmCreateContext(nullptr);
    VtmSurface* const other = vtmCreateSurface(4, 4, &sRGBA8888);
    const VGPath path = rectangle(1, 1, 2, 2);
    vgSetf(VG_STROKE_LINE_WIDTH, 9);
    ASSERT_TRUE(vtmMakeCurrent(friendly, other));
    EXPECT_EQ(vgGetf(VG_STROKE_LINE_WIDTH), 1);
    EXPECT_EQ(vgGetParameteri(path, VG_PATH_NUM_SEGMENTS), 5);
    EXPECT_EQ(vgGetError(), VG_NO_ERROR);
    ASSERT_TRUE(vtmMakeCurrent(stranger, other));
    EXPECT_VG_ERROR(VG_BAD_HANDLE_ERROR, vgDrawPath(path, VG_FILL_PATH));
    // Objects outlive the context that made them.
    ASSERT_TRUE(vtmMakeCurrent(friendly, other));
    vtmDestroyContext(context);
    EXPECT_VG_ERROR(VG_NO_ERROR, vgDrawPath(path, VG_FILL_PATH));
    EXPECT_EQ(pixel(1, 1)[3], 255);
    context = friendly;
    vtmDestroyContext(stranger);
    ASSERT_TRUE(vtmMakeCurrent(context, surface));
    vtmDestroySurface(other);
}

TEST_F(ContextsTest, DestroyedObjectsLiveWhileUsed) {
    // Section 9.1.1: a paint that is set; section 9.4: a paint's pattern.
    VGPaint paint = newPaint({0, 1, 0, 1});
    const VGPath square = rectangle(0, 0, 1, 1);
    vgSetPaint(paint, VG_FILL_PATH | VG_STROKE_PATH);
    EXPECT_EQ(vgGetPaint(VG_FILL_PATH), paint);
    EXPECT_EQ(vgGetPaint(VG_STROKE_PATH), paint);
    vgDestroyPaint(paint);
    EXPECT_EQ(vgGetPaint(VG_FILL_PATH), VG_INVALID_HANDLE);
    vgDrawPath(square, VG_FILL_PATH);
    EXPECT_EQ(pixel(0, 0), (Rgba{0, 255, 0, 255}));
    paint = vgCreatePaint();
    vgSetPaint(paint, VG_FILL_PATH);
    const VGImage image = newImage({{1, 2, 3, 255}});
    vgPaintPattern(paint, image);
    vgSetParameteri(paint, VG_PAINT_TYPE, VG_PAINT_TYPE_PATTERN);
    vgDestroyImage(image);
    vgDrawPath(square, VG_FILL_PATH);
    EXPECT_EQ(pixel(0, 0), (Rgba{1, 2, 3, 255}));
    // Without a pattern the paint is its colour; without a paint black.
    vgPaintPattern(paint, VG_INVALID_HANDLE);
    vgSetColor(paint, 0xff8000ff);
    EXPECT_EQ(vgGetColor(paint), 0xff8000ffu);
    vgDrawPath(square, VG_FILL_PATH);
    EXPECT_EQ(pixel(0, 0), (Rgba{255, 128, 0, 255}));
    vgSetPaint(VG_INVALID_HANDLE, VG_FILL_PATH);
    vgDrawPath(square, VG_FILL_PATH);
    EXPECT_EQ(pixel(0, 0), (Rgba{0, 0, 0, 255}));
}

TEST_F(ContextsTest, ColorsAreRoundedAndClamped) {
    const VGPaint paint = newPaint({-1, 0.5f, 2, 1});
    EXPECT_EQ(vgGetColor(paint), 0x0080ffffu);
}

TEST_F(ContextsTest, SurfacesAreMadeReadAndResized) {
    EXPECT_EQ(vtmCreateSurface(0, 1, &sRGBA8888), nullptr);
    EXPECT_EQ(vtmCreateSurface(1, 16385, &sRGBA8888), nullptr);
    const VtmSurfaceFormat odd{8, 8, 8, 7, 0, 8, VG_FALSE, VG_FALSE};
    EXPECT_EQ(vtmCreateSurface(1, 1, &odd), nullptr);
    EXPECT_EQ(vtmGetCurrentContext(), context);
    EXPECT_EQ(vtmGetCurrentSurface(), surface);
    clear({1, 0, 0, 0.5f});
    ASSERT_TRUE(vtmResizeSurface(surface, 20, 3));
    EXPECT_EQ(vtmSurfaceWidth(surface), 20);
    EXPECT_EQ(vtmSurfaceHeight(surface), 3);
    EXPECT_FALSE(vtmResizeSurface(surface, 0, 3));
    std::vector<std::uint8_t> bytes(20 * 3 * 4);
    vtmReadSurface(surface, bytes.data(), 80);
    EXPECT_TRUE(isNear({bytes[0], bytes[1], bytes[2], bytes[3]}, {128, 0, 0, 128}, 1)) << "premultiplied";
    EXPECT_EQ(bytes[79], 0) << "new";
    EXPECT_FALSE(vtmMakeCurrent(context, nullptr));
    EXPECT_NE(vtmGetProcAddress("vgDrawPath"), nullptr);
    EXPECT_NE(vtmGetProcAddress("vguArc"), nullptr);
    EXPECT_EQ(vtmGetProcAddress("malloc"), nullptr);
    EXPECT_EQ(vtmGetProcAddress("vgNoSuchThing"), nullptr);
}

TEST_F(ContextsTest, ImagesAsSurfaces) {
    const VGImage image = newImage(VG_sRGBA_8888, 4, 4);
    VtmSurface* const drawn = vtmCreateImageSurface(context, image, 8, nullptr);
    ASSERT_NE(drawn, nullptr);
    ASSERT_TRUE(vtmMakeCurrent(context, drawn));
    clear({0.2f, 0.4f, 0.6f, 1});
    EXPECT_FALSE(vtmResizeSurface(drawn, 5, 5));
    ASSERT_TRUE(vtmMakeCurrent(context, surface));
    vtmDestroySurface(drawn);
    EXPECT_EQ(texel(image, 3, 3), (Rgba{51, 102, 153, 255}));
}

TEST_F(ContextsTest, Queries) {
    EXPECT_NE(vgGetString(VG_VENDOR), nullptr);
    EXPECT_NE(vgGetString(VG_RENDERER), nullptr);
    EXPECT_STREQ(reinterpret_cast<const char*>(vgGetString(VG_VERSION)), "1.1");
    EXPECT_NE(vgGetString(VG_EXTENSIONS), nullptr);
    EXPECT_EQ(vgGetString(VGStringID(0)), nullptr);
    for (const VGint format : {VG_sRGBA_8888, VG_A_1, VG_lABGR_8888_PRE}) {
        const VGHardwareQueryResult result = vgHardwareQuery(VG_IMAGE_FORMAT_QUERY, format);
        EXPECT_TRUE(result == VG_HARDWARE_ACCELERATED || result == VG_HARDWARE_UNACCELERATED);
    }
    const VGHardwareQueryResult result = vgHardwareQuery(VG_PATH_DATATYPE_QUERY, VG_PATH_DATATYPE_F);
    EXPECT_TRUE(result == VG_HARDWARE_ACCELERATED || result == VG_HARDWARE_UNACCELERATED);
    vgFlush();
    vgFinish();
    EXPECT_EQ(vgGetError(), VG_NO_ERROR);
}

TEST_F(ContextsTest, SurfacesAreReadInAnyFormat) {
    const VGfloat halfRed[] = {1, 0, 0, 0.5f}, blue[] = {0, 0, 1, 1};
    vgSetfv(VG_CLEAR_COLOR, 4, halfRed);
    vgClear(0, 0, 16, 16);
    vgSetfv(VG_CLEAR_COLOR, 4, blue);
    vgClear(1, 1, 1, 1);
    // From the top, and (0, 1) of the surface first.
    std::array<std::uint32_t, 4> words{};
    ASSERT_TRUE(vtmReadSurfaceAs(surface, VG_sARGB_8888_PRE, 0, 0, 2, 2, words.data(), 8));
    EXPECT_EQ(words, (std::array<std::uint32_t, 4>{0x80800000, 0xff0000ff, 0x80800000, 0x80800000}));
    std::array<std::uint16_t, 4> small{};
    ASSERT_TRUE(vtmReadSurfaceAs(surface, VG_sRGB_565, 0, 0, 2, 2, small.data(), 4));
    EXPECT_EQ(small, (std::array<std::uint16_t, 4>{0xf800, 0x001f, 0xf800, 0xf800}));
    EXPECT_FALSE(vtmReadSurfaceAs(surface, VG_BW_1, 0, 0, 1, 1, small.data(), 4));
    EXPECT_FALSE(vtmReadSurfaceAs(surface, VGImageFormat(12345), 0, 0, 1, 1, small.data(), 4));
}

// ---- Threads --------------------------------------------------------------------------------------

TEST_F(ContextsTest, AContextIsCurrentInOneThread) {
    std::thread([&] {
        VtmSurface* const other = vtmCreateSurface(2, 2, &sRGBA8888);
        EXPECT_FALSE(vtmMakeCurrent(context, other));
        VtmContext* const own = vtmCreateContext(context);
        EXPECT_FALSE(vtmMakeCurrent(own, surface));
        EXPECT_TRUE(vtmMakeCurrent(own, other));
        // Both go with the thread.
        vtmDestroyContext(own);
        vtmDestroySurface(other);
    }).join();
    EXPECT_EQ(vtmGetCurrentContext(), context);
}

/// Each thread draws its colour with a path and an image that all have; half of them share contexts.
TEST_F(ContextsTest, ThreadsDrawAtOnce) {
    constexpr int threads = 4, rounds = 40;
    const VGPath shared = rectangle(1, 1, 6, 6);
    const VGImage target = newImage(VG_sRGBA_8888, 8, 8);
    std::atomic<int> right = 0;
    const auto work = [&](int number) {
        const bool shares = number % 2 == 0;
        VtmContext* const own = vtmCreateContext(shares ? context : nullptr);
        VtmSurface* const plain = vtmCreateSurface(8, 8, &sRGBA8888);
        vtmMakeCurrent(own, plain);
        const VGPath path = shares ? shared : rectangle(1, 1, 6, 6);
        const Rgba color{60 * number, 255 - 60 * number, 7, 255};
        const VGPaint paint = newPaint({VGfloat(color[0]) / 255, VGfloat(color[1]) / 255, 7.0f / 255, 1});
        vgSetPaint(paint, VG_FILL_PATH | VG_STROKE_PATH);
        for (int round = 0; round < rounds; ++round) {
            vgClear(0, 0, 8, 8);
            vgSetf(VG_STROKE_LINE_WIDTH, VGfloat(round % 3 + 1) / 2);
            vgDrawPath(path, VG_FILL_PATH | VG_STROKE_PATH);
            std::uint32_t word = 0;
            vgReadPixels(&word, 4, VG_sRGBA_8888, 3, 3, 1, 1);
            right += word == wordOf(color);
            if (!shares)
                continue;
            // In turn a target of one thread and refused to the others.
            if (VtmSurface* const inImage = vtmCreateImageSurface(own, target, 8, nullptr)) {
                if (vtmMakeCurrent(own, inImage))
                    vgClear(0, 0, 8, 8);
                vtmMakeCurrent(own, plain);
                vtmDestroySurface(inImage);
            }
            vgDrawImage(target);
            vgDestroyPaint(vgCreatePaint());
        }
        const VGErrorCode error = vgGetError();
        EXPECT_TRUE(error == VG_NO_ERROR || error == VG_IMAGE_IN_USE_ERROR);
        vtmMakeCurrent(nullptr, nullptr);
        vtmDestroySurface(plain);
        vtmDestroyContext(own);
    };
    std::vector<std::thread> running;
    for (int i = 0; i < threads; ++i)
        running.emplace_back(work, i);
    for (std::thread& thread : running)
        thread.join();
    EXPECT_EQ(right, threads * rounds);
}

}  // namespace

}  // namespace vtm::openvg::testing
