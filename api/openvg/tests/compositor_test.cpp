// Surfaces that shaders draw on: as those that the CPU draws on, whatever is mixed and moved between the two.

#include "api/openvg/tests/fixture.hpp"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <random>
#include <thread>

#include <glm/vec2.hpp>

namespace vtm::openvg::testing {
namespace {

using Picture = std::vector<std::uint8_t>;

Picture read(VtmSurface* surface) {
    Picture pixels(std::size_t(vtmSurfaceWidth(surface)) * std::size_t(vtmSurfaceHeight(surface)) * 4);
    vtmReadSurface(surface, pixels.data(), std::size_t(vtmSurfaceWidth(surface)) * 4);
    return pixels;
}

int difference(const Picture& a, const Picture& b) {
    int largest = a.size() == b.size() ? 0 : 256;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        largest = std::max(largest, std::abs(int(a[i]) - int(b[i])));
    return largest;
}

class CompositorTest : public VgTest {
protected:
    CompositorTest() : VgTest(64, 48) {
        hasGl = vtmChooseCompositor(surface, VTM_COMPOSITOR_GL) == VTM_COMPOSITOR_GL;
    }
    void SetUp() override {
        if (!hasGl)
            GTEST_SKIP() << "no OpenGL ES 3: " << vtmGetCompositorFault();
    }

    /// What calls draw on a new surface.
    Picture drawn(VtmCompositor compositor, int width, int height, const VtmSurfaceFormat& format,
                  const std::function<void()>& calls) {
        useSurface(width, height, format);
        vtmChooseCompositor(surface, compositor);
        calls();
        EXPECT_EQ(vgGetError(), VG_NO_ERROR);
        return read(surface);
    }
    int between(int width, int height, const VtmSurfaceFormat& format, const std::function<void()>& calls) {
        const Picture cpu = drawn(VTM_COMPOSITOR_CPU, width, height, format, calls);
        const Picture gl = drawn(VTM_COMPOSITOR_GL, width, height, format, calls);
        return difference(cpu, gl);
    }

    bool hasGl;
};

void fillRectangle(VGfloat x, VGfloat y, VGfloat width, VGfloat height, std::array<VGfloat, 4> color) {
    const VGPath path =
        vgCreatePath(VG_PATH_FORMAT_STANDARD, VG_PATH_DATATYPE_F, 1, 0, 0, 0, VG_PATH_CAPABILITY_ALL);
    vguRect(path, x, y, width, height);
    const VGPaint paint = vgCreatePaint();
    vgSetParameterfv(paint, VG_PAINT_COLOR, 4, color.data());
    vgSetPaint(paint, VG_FILL_PATH);
    vgDrawPath(path, VG_FILL_PATH);
    vgDestroyPaint(paint);
    vgDestroyPath(path);
}

TEST_F(CompositorTest, OnePixelIsEnough) {
    EXPECT_LE(between(1, 1, sRGBA8888,
                      [] {
                          fillRectangle(0.25f, 0.25f, 0.5f, 0.5f, {1, 0.5f, 0, 0.75f});
                      }),
              1);
}

TEST_F(CompositorTest, WideSurfacesAreDrawnToTheirEnds) {
    EXPECT_LE(between(5000, 3, sRGBA8888,
                      [] {
                          fillRectangle(10.5f, 0.5f, 4980.25f, 2, {1, 1, 1, 1});
                          fillRectangle(4990.5f, 0, 20, 3, {0, 1, 0, 0.5f});
                      }),
              1);
}

TEST_F(CompositorTest, AnEdgeInEveryTileIsAsManySharesAsPixels) {
    EXPECT_LE(between(1500, 1500, {8, 8, 8, 8, 0, 0, VG_FALSE, VG_TRUE},
                      [] {
                          const VGPath path = vgCreatePath(VG_PATH_FORMAT_STANDARD, VG_PATH_DATATYPE_F, 1, 0,
                                                           0, 0, VG_PATH_CAPABILITY_ALL);
                          for (int i = 0; i < 150; ++i)
                              vguRect(path, 0.5f, 10 * VGfloat(i) + 0.25f, 1499, 5);
                          vgDrawPath(path, VG_FILL_PATH);
                          vgDestroyPath(path);
                      }),
              1);
}

TEST_F(CompositorTest, ChoosingAnotherKeepsThePixels) {
    fillRectangle(0, 0, 32, 48, {1, 0, 0, 1});
    const Picture before = read(surface);
    vtmChooseCompositor(surface, VTM_COMPOSITOR_CPU);
    EXPECT_EQ(read(surface), before);
    fillRectangle(32, 0, 32, 48, {0, 0, 1, 1});
    vtmChooseCompositor(surface, VTM_COMPOSITOR_GL);
    fillRectangle(16, 16, 32, 8, {0, 1, 0, 1});
    EXPECT_EQ(pixel(0, 0), (Rgba{255, 0, 0, 255}));
    EXPECT_EQ(pixel(63, 0), (Rgba{0, 0, 255, 255}));
    EXPECT_EQ(pixel(20, 20), (Rgba{0, 255, 0, 255}));
}

TEST_F(CompositorTest, ResizingKeepsThePixels) {
    fillRectangle(0, 0, 64, 48, {1, 0, 0, 1});
    EXPECT_TRUE(vtmResizeSurface(surface, 100, 20));
    fillRectangle(64, 0, 36, 20, {0, 1, 0, 1});
    EXPECT_EQ(pixel(63, 19), (Rgba{255, 0, 0, 255}));
    EXPECT_EQ(pixel(99, 0), (Rgba{0, 255, 0, 255}));
}

TEST_F(CompositorTest, PartsOfASurfaceAreCopiedOverEachOther) {
    for (const glm::ivec2 by : {glm::ivec2(3, 2), glm::ivec2(-3, -2), glm::ivec2(5, -4)})
        EXPECT_EQ(between(64, 48, sRGBA8888,
                          [&] {
                              for (int i = 0; i < 16; ++i)
                                  fillRectangle(VGfloat(4 * i), VGfloat(3 * i), 4, 3,
                                                {VGfloat(i) / 16, 1 - VGfloat(i) / 16, 0.5f, 1});
                              for (int i = 0; i < 4; ++i)
                                  vgCopyPixels(8 + by.x, 8 + by.y, 8, 8, 40, 30);
                          }),
                  0);
}

TEST_F(CompositorTest, ImagesDrawnIntoAreDrawnFrom) {
    // A surface in an image, then the image on a surface, by children too.
    const auto calls = [&] {
        const VGImage image = vgCreateImage(VG_sABGR_8888, 32, 32, VG_IMAGE_QUALITY_NONANTIALIASED);
        VtmSurface* const main = vtmGetCurrentSurface();
        VtmSurface* const inImage = vtmCreateImageSurface(context, image, 0, nullptr);
        ASSERT_NE(inImage, nullptr);
        vtmChooseCompositor(inImage, vtmGetCompositor(main));
        vtmMakeCurrent(context, inImage);
        fillRectangle(4, 4, 20, 20, {1, 1, 0, 0.5f});
        vtmMakeCurrent(context, main);
        vtmDestroySurface(inImage);
        vgDrawImage(image);
        const VGImage child = vgChildImage(image, 8, 8, 16, 16);
        vgSetPixels(40, 20, child, 0, 0, 16, 16);
        vgGetPixels(child, 0, 0, 2, 2, 12, 12);
        vgSeti(VG_MATRIX_MODE, VG_MATRIX_IMAGE_USER_TO_SURFACE);
        vgTranslate(30, 2);
        vgDrawImage(image);
        vgLoadIdentity();
        vgDestroyImage(child);
        vgDestroyImage(image);
    };
    EXPECT_LE(between(64, 48, sRGBA8888, calls), 1);
}

TEST_F(CompositorTest, FiltersReadWhatWasDrawn) {
    const auto calls = [] {
        const VGImage image = vgCreateImage(VG_sRGBA_8888_PRE, 64, 48, VG_IMAGE_QUALITY_BETTER),
                      blurred = vgCreateImage(VG_sRGBA_8888_PRE, 64, 48, VG_IMAGE_QUALITY_BETTER);
        fillRectangle(20, 20, 20, 10, {1, 0, 0, 1});
        vgGetPixels(image, 0, 0, 0, 0, 64, 48);
        vgGaussianBlur(blurred, image, 3, 3, VG_TILE_PAD);
        vgDrawImage(blurred);
        vgDestroyImage(image);
        vgDestroyImage(blurred);
    };
    EXPECT_LE(between(64, 48, sRGBA8888, calls), 1);
}

TEST_F(CompositorTest, ColoursUnderNoAlphaAreKept) {
    // On surfaces without premultiplied alpha they are there, and can be read.
    const auto calls = [] {
        const VGfloat color[] = {0.8f, 0.4f, 0.2f, 0};
        vgSetfv(VG_CLEAR_COLOR, 4, color);
        vgClear(0, 0, 20, 20);
    };
    for (const VtmCompositor compositor : {VTM_COMPOSITOR_CPU, VTM_COMPOSITOR_GL}) {
        drawn(compositor, 20, 20, sRGBA8888, calls);
        EXPECT_EQ(pixel(3, 3), (Rgba{204, 102, 51, 0}));
    }
}

TEST_F(CompositorTest, ManyScissorsAndAMask) {
    const auto calls = [] {
        std::vector<VGint> rectangles;
        for (VGint i = 0; i < 10; ++i)
            rectangles.insert(rectangles.end(), {5 * i, 3 * i, 9, 11});
        vgSetiv(VG_SCISSOR_RECTS, VGint(rectangles.size()), rectangles.data());
        vgSeti(VG_SCISSORING, VG_TRUE);
        vgSeti(VG_MASKING, VG_TRUE);
        vgMask(VG_INVALID_HANDLE, VG_CLEAR_MASK, 10, 10, 10, 10);
        fillRectangle(1.5f, 1.5f, 60, 44, {0.2f, 0.6f, 1, 0.8f});
        vgMask(VG_INVALID_HANDLE, VG_FILL_MASK, 12, 12, 4, 4);
        fillRectangle(2.5f, 0, 60, 48, {1, 0.6f, 0, 0.3f});
        vgSeti(VG_MASKING, VG_FALSE);
        vgSeti(VG_SCISSORING, VG_FALSE);
    };
    EXPECT_LE(between(64, 48, sRGBA8888, calls), 1);
}

TEST_F(CompositorTest, ThreadsDrawOnSurfacesOfTheirOwn) {
    constexpr int count = 4;
    std::array<Picture, count> pictures;
    std::vector<std::thread> threads;
    for (int t = 0; t < count; ++t)
        threads.emplace_back([&, t] {
            VtmSurface* const own = vtmCreateSurface(60, 60, &sRGBA8888);
            VtmContext* const ownContext = vtmCreateContext(nullptr);
            vtmChooseCompositor(own, VTM_COMPOSITOR_GL);
            vtmMakeCurrent(ownContext, own);
            for (int i = 0; i < 50; ++i)
                fillRectangle(VGfloat(i) + 0.5f, VGfloat(i) / 2, 10, 20, {VGfloat(t) / count, 1, 0, 0.5f});
            pictures[std::size_t(t)] = read(own);
            vtmMakeCurrent(nullptr, nullptr);
            vtmDestroyContext(ownContext);
            vtmDestroySurface(own);
        });
    for (std::thread& thread : threads)
        thread.join();
    for (int t = 0; t < count; ++t)
        EXPECT_EQ(pictures[std::size_t(t)], drawn(VTM_COMPOSITOR_GL, 60, 60, sRGBA8888, [&] {
                      for (int i = 0; i < 50; ++i)
                          fillRectangle(VGfloat(i) + 0.5f, VGfloat(i) / 2, 10, 20,
                                        {VGfloat(t) / count, 1, 0, 0.5f});
                  }));
}

TEST_F(CompositorTest, FlushingAndFinishingKeepTheOrder) {
    fillRectangle(0, 0, 64, 48, {1, 0, 0, 1});
    vgFlush();
    fillRectangle(0, 0, 64, 48, {0, 1, 0, 1});
    vgFinish();
    fillRectangle(0, 0, 32, 48, {0, 0, 1, 1});
    EXPECT_EQ(pixel(5, 5), (Rgba{0, 0, 255, 255}));
    EXPECT_EQ(pixel(40, 5), (Rgba{0, 255, 0, 255}));
}

}  // namespace
}  // namespace vtm::openvg::testing
