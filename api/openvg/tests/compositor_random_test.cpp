// Random drawings through both compositors: surfaces of every format, paints, images, masks, scissors, blend
// modes and colour transforms as they come.

#include "api/openvg/tests/fixture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>

#include <VG/vgext.h>

namespace vtm::openvg::testing {
namespace {

using Picture = std::vector<std::uint8_t>;

constexpr int width = 61, height = 47;

/// A surface, and the image format that has its values as bytes: they are compared as they are stored.
struct Kind {
    VtmSurfaceFormat format;
    VGImageFormat name;
    int pixelBytes;
};
constexpr std::array<Kind, 7> kinds{{{{8, 8, 8, 8, 0, 8, VG_FALSE, VG_TRUE}, VG_sABGR_8888_PRE, 4},
                                     {{8, 8, 8, 8, 0, 8, VG_FALSE, VG_FALSE}, VG_sABGR_8888, 4},
                                     {{8, 8, 8, 8, 0, 8, VG_TRUE, VG_TRUE}, VG_lABGR_8888_PRE, 4},
                                     {{8, 8, 8, 8, 0, 8, VG_TRUE, VG_FALSE}, VG_lABGR_8888, 4},
                                     {{8, 8, 8, 0, 0, 8, VG_FALSE, VG_FALSE}, VG_sXBGR_8888, 4},
                                     {{0, 0, 0, 8, 0, 8, VG_TRUE, VG_FALSE}, VG_A_8, 1},
                                     {{0, 0, 0, 0, 8, 8, VG_FALSE, VG_FALSE}, VG_sL_8, 1}}};
/// Where channels have few levels a rounding is a large step.
constexpr std::array<VtmSurfaceFormat, 4> coarse{{{5, 6, 5, 0, 0, 8, VG_FALSE, VG_FALSE},
                                                  {5, 5, 5, 1, 0, 8, VG_FALSE, VG_TRUE},
                                                  {4, 4, 4, 4, 0, 8, VG_FALSE, VG_FALSE},
                                                  {0, 0, 0, 0, 1, 8, VG_TRUE, VG_FALSE}}};

/// Calls that a seed decides, the same whatever draws them.
class RandomDrawing {
public:
    explicit RandomDrawing(unsigned seed) : random_(seed) {}

    void run() {
        makeImages();
        for (int i = 0; i < calls; ++i)
            call();
    }

private:
    static constexpr int calls = 12;

    int below(int end) { return int(random_() % unsigned(end)); }
    bool oneIn(int n) { return below(n) == 0; }
    /// Dyadic, so that no place is on a border for one compositor and beside it for the other.
    VGfloat unit() { return VGfloat(random_() & 0xff) / 256; }
    VGfloat odd() { return unit() + 1 / 511.0f; }
    std::array<VGfloat, 4> color() { return {unit(), unit(), unit(), oneIn(3) ? VGfloat(below(2)) : unit()}; }

    void makeImages() {
        constexpr std::array names{
            VG_sRGBA_8888, VG_sABGR_8888_PRE, VG_lRGBA_8888_PRE, VG_sRGBX_8888, VG_sRGB_565, VG_sRGBA_5551,
            VG_sARGB_4444, VG_sL_8,           VG_lL_8,           VG_A_8,        VG_BW_1,     VG_A_4};
        for (VGImage& image : images_) {
            const VGImageFormat name = names[std::size_t(below(int(names.size())))];
            const int w = 1 + below(40), h = 1 + below(30);
            image = vgCreateImage(
                name, w, h,
                VG_IMAGE_QUALITY_NONANTIALIASED | VG_IMAGE_QUALITY_FASTER | VG_IMAGE_QUALITY_BETTER);
            std::vector<std::uint32_t> words(std::size_t(w * h));
            for (std::uint32_t& word : words)
                word = std::uint32_t(random_()) | (oneIn(3) ? 255u : 0u);
            vgImageSubData(image, words.data(), 4 * w, VG_sRGBA_8888, 0, 0, w, h);
        }
        VGImage& child = images_.back();
        const VGImage parent = child;
        child = vgChildImage(parent, 0, 0, 1 + below(vgGetParameteri(parent, VG_IMAGE_WIDTH)),
                             1 + below(vgGetParameteri(parent, VG_IMAGE_HEIGHT)));
        vgDestroyImage(parent);
    }
    VGImage image() { return images_[std::size_t(below(int(images_.size())))]; }

    void setState() {
        vgSeti(VG_BLEND_MODE, oneIn(3)   ? VG_BLEND_OVERLAY_KHR + below(23)
                              : oneIn(2) ? VG_BLEND_SRC_OVER
                                         : VG_BLEND_SRC + below(10));
        vgSeti(VG_IMAGE_QUALITY, 1 << below(3));
        vgSeti(VG_IMAGE_MODE, VG_DRAW_IMAGE_NORMAL + below(3));
        vgSeti(VG_RENDERING_QUALITY,
               oneIn(4) ? VG_RENDERING_QUALITY_NONANTIALIASED : VG_RENDERING_QUALITY_BETTER);
        vgSeti(VG_MASKING, oneIn(3));
        vgSeti(VG_COLOR_TRANSFORM, oneIn(4));
        std::array<VGfloat, 8> values;
        for (std::size_t i = 0; i < 8; ++i)
            values[i] = i < 4 ? 2 * unit() : unit() - 0.5f;
        vgSetfv(VG_COLOR_TRANSFORM_VALUES, 8, values.data());
        vgSeti(VG_SCISSORING, oneIn(3));
        std::vector<VGint> rectangles;
        for (int i = 1 + below(5); i > 0; --i)
            rectangles.insert(rectangles.end(), {below(width) - 5, below(height) - 5, below(50), below(40)});
        vgSetiv(VG_SCISSOR_RECTS, VGint(rectangles.size()), rectangles.data());
        vgSetfv(VG_CLEAR_COLOR, 4, color().data());
        vgSetfv(VG_TILE_FILL_COLOR, 4, color().data());
    }

    void loadMatrix(VGMatrixMode mode, VGfloat zoom) {
        vgSeti(VG_MATRIX_MODE, mode);
        vgLoadIdentity();
        vgTranslate(VGfloat(below(40)) + odd(), VGfloat(below(30)) + odd());
        if (oneIn(3))
            return;
        vgRotate(360 * odd());
        vgScale(zoom * (0.25f + 2 * odd()), zoom * (0.25f + 2 * odd()));
        if (mode == VG_MATRIX_IMAGE_USER_TO_SURFACE && oneIn(4)) {
            const std::array<VGfloat, 9> m{1, 0, 0.004f * odd(), 0, 1, 0.003f * odd(), 0, 0, 1};
            vgMultMatrix(m.data());
        }
    }

    VGPaint newPaint() {
        const VGPaint paint = vgCreatePaint();
        vgSetParameteri(paint, VG_PAINT_TYPE, VG_PAINT_TYPE_COLOR + below(4));
        vgSetParameterfv(paint, VG_PAINT_COLOR, 4, color().data());
        vgSetParameteri(paint, VG_PAINT_COLOR_RAMP_SPREAD_MODE, VG_COLOR_RAMP_SPREAD_PAD + below(3));
        vgSetParameteri(paint, VG_PAINT_COLOR_RAMP_PREMULTIPLIED, below(2));
        std::vector<VGfloat> stops;
        for (VGfloat offset = 0; offset <= 1; offset += 0.1f + unit() / 2) {
            stops.push_back(offset);
            for (const VGfloat v : color())
                stops.push_back(v);
        }
        vgSetParameterfv(paint, VG_PAINT_COLOR_RAMP_STOPS, VGint(stops.size()), stops.data());
        const std::array<VGfloat, 5> p{60 * odd(), 40 * odd(), 60 * odd(), 40 * odd(), 5 + 40 * odd()};
        vgSetParameterfv(paint, VG_PAINT_LINEAR_GRADIENT, 4, p.data());
        vgSetParameterfv(paint, VG_PAINT_RADIAL_GRADIENT, 5, p.data());
        vgSetParameteri(paint, VG_PAINT_PATTERN_TILING_MODE, VG_TILE_FILL + below(4));
        vgPaintPattern(paint, image());
        return paint;
    }

    void drawPath() {
        const VGPath path =
            vgCreatePath(VG_PATH_FORMAT_STANDARD, VG_PATH_DATATYPE_F, 1, 0, 0, 0, VG_PATH_CAPABILITY_ALL);
        if (oneIn(2))
            vguEllipse(path, 30 * unit(), 20 * unit(), 1 + 60 * unit(), 1 + 50 * unit());
        else
            vguRoundRect(path, 0, 0, 1 + 40 * unit(), 1 + 40 * unit(), 10 * unit(), 10 * unit());
        loadMatrix(VG_MATRIX_FILL_PAINT_TO_USER, 1);
        loadMatrix(VG_MATRIX_PATH_USER_TO_SURFACE, 1);
        vgSetf(VG_STROKE_LINE_WIDTH, 5 * unit());
        vgDrawPath(path, VGbitfield(1 + below(3)));
        vgDestroyPath(path);
    }

    void call() {
        setState();
        const VGPaint paint = newPaint();
        vgSetPaint(paint, VG_FILL_PATH | VG_STROKE_PATH);
        switch (below(9)) {
            case 0:
                vgClear(below(width), below(height), 1 + below(width), 1 + below(height));
                break;
            case 1:
                vgSetPixels(below(width), below(height), image(), below(5), below(5), 1 + below(30),
                            1 + below(30));
                break;
            case 2:
                vgGetPixels(image(), below(5), below(5), below(20), below(20), 1 + below(30), 1 + below(30));
                break;
            case 3:
                vgCopyPixels(below(30), below(30), below(30), below(30), 1 + below(40), 1 + below(40));
                break;
            case 4:
                vgMask(image(), VGMaskOperation(VG_CLEAR_MASK + below(5)), below(30), below(30),
                       1 + below(40), 1 + below(40));
                break;
            case 5:
            case 6:
                loadMatrix(VG_MATRIX_FILL_PAINT_TO_USER, 1);
                loadMatrix(VG_MATRIX_IMAGE_USER_TO_SURFACE, 1);
                vgDrawImage(image());
                break;
            default:
                drawPath();
        }
        vgSetPaint(VG_INVALID_HANDLE, VG_FILL_PATH | VG_STROKE_PATH);
        vgDestroyPaint(paint);
    }

    std::mt19937 random_;
    std::array<VGImage, 4> images_{};
};

class RandomDrawings : public ::testing::Test {
protected:
    void SetUp() override {
        VtmSurface* const surface = vtmCreateSurface(1, 1, &kinds[0].format);
        if (vtmChooseCompositor(surface, VTM_COMPOSITOR_GL) != VTM_COMPOSITOR_GL)
            why = "no OpenGL ES 3: " + std::string(vtmGetCompositorFault());
        vtmDestroySurface(surface);
        if (!why.empty())
            GTEST_SKIP() << why;
    }

    static Picture drawn(unsigned seed, VtmCompositor compositor, const VtmSurfaceFormat& format,
                         VGImageFormat name, int pixelBytes) {
        VtmSurface* const surface = vtmCreateSurface(width, height, &format);
        vtmChooseCompositor(surface, compositor);
        VtmContext* const context = vtmCreateContext(nullptr);
        vtmMakeCurrent(context, surface);
        RandomDrawing(seed).run();
        EXPECT_EQ(vtmGetCompositor(surface), compositor) << vtmGetCompositorFault();
        Picture pixels(std::size_t(width * height * pixelBytes));
        vgReadPixels(pixels.data(), width * pixelBytes, name, 0, 0, width, height);
        vtmMakeCurrent(nullptr, nullptr);
        vtmDestroyContext(context);
        vtmDestroySurface(surface);
        return pixels;
    }

    struct Difference {
        std::size_t channels = 0, changed = 0;  ///< all, and those that are not 0
        std::size_t off = 0;                    ///< by more than 1/255
    };
    static void compare(unsigned seed, const VtmSurfaceFormat& format, VGImageFormat name, int pixelBytes,
                        Difference& difference) {
        const Picture cpu = drawn(seed, VTM_COMPOSITOR_CPU, format, name, pixelBytes),
                      gl = drawn(seed, VTM_COMPOSITOR_GL, format, name, pixelBytes);
        for (std::size_t i = 0; i < cpu.size(); ++i) {
            ++difference.channels;
            difference.changed += cpu[i] != 0;
            difference.off += std::abs(int(cpu[i]) - int(gl[i])) > 1;
        }
    }

    std::string why;
};

unsigned sampled(unsigned all) { return std::getenv("VTM_TEST_ALL") ? all : all * 2 / 5; }

/// A rounding that falls the other way is one step. Blend modes that divide, and steps of gradients and of
/// nearest texels, make more of it at single pixels.
TEST_F(RandomDrawings, AreTheSame) {
    Difference difference;
    for (unsigned seed = 0; seed < sampled(70); ++seed) {
        const Kind& kind = kinds[seed % kinds.size()];
        compare(seed, kind.format, kind.name, kind.pixelBytes, difference);
    }
    EXPECT_GT(difference.changed, difference.channels / 4);
    EXPECT_LE(double(difference.off), 1e-4 * double(difference.channels));
}

TEST_F(RandomDrawings, AreAlmostTheSameInFewLevels) {
    Difference difference;
    for (unsigned seed = 1000; seed < 1000 + sampled(40); ++seed)
        compare(seed, coarse[seed % coarse.size()], VG_sABGR_8888_PRE, 4, difference);
    EXPECT_LE(double(difference.off), 2e-3 * double(difference.channels));
}

}  // namespace
}  // namespace vtm::openvg::testing
