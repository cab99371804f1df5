/// \file
/// A context and a surface in memory, current for the length of a test.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include <VG/vgu.h>
#include <vtm/vg.h>

namespace vtm::openvg::testing {

inline constexpr VtmSurfaceFormat sRGBA8888{8, 8, 8, 8, 0, 8, VG_FALSE, VG_FALSE};
inline constexpr VtmSurfaceFormat linear8888{8, 8, 8, 8, 0, 8, VG_TRUE, VG_TRUE};

/// Red, green, blue, alpha: what VG_sRGBA_8888 has in its word from the highest byte on.
using Rgba = std::array<int, 4>;
inline std::uint32_t wordOf(Rgba c) {
    return std::uint32_t(c[0]) << 24 | std::uint32_t(c[1]) << 16 | std::uint32_t(c[2]) << 8 |
           std::uint32_t(c[3]);
}
inline Rgba rgbaOf(std::uint32_t word) {
    return {int(word >> 24), int(word >> 16 & 255), int(word >> 8 & 255), int(word & 255)};
}

class VgTest : public ::testing::Test {
protected:
    explicit VgTest(int width = 16, int height = 16, const VtmSurfaceFormat& format = sRGBA8888)
        : context(vtmCreateContext(nullptr)), surface(vtmCreateSurface(width, height, &format)) {
        EXPECT_TRUE(vtmMakeCurrent(context, surface));
    }
    ~VgTest() override {
        vtmMakeCurrent(nullptr, nullptr);
        vtmDestroySurface(surface);
        vtmDestroyContext(context);
    }

    /// A surface of another format in place of the one there is.
    void useSurface(int width, int height, const VtmSurfaceFormat& format) {
        VtmSurface* const other = vtmCreateSurface(width, height, &format);
        EXPECT_TRUE(vtmMakeCurrent(context, other));
        vtmDestroySurface(surface);
        surface = other;
    }

    /// Without premultiplied alpha, sRGB.
    Rgba pixel(int x, int y, VGImageFormat format = VG_sRGBA_8888) const {
        std::uint32_t word = 0;
        vgReadPixels(&word, 4, format, x, y, 1, 1);
        return rgbaOf(word);
    }
    void setPixel(int x, int y, Rgba c, VGImageFormat format = VG_sRGBA_8888) const {
        const std::uint32_t word = wordOf(c);
        vgWritePixels(&word, 4, format, x, y, 1, 1);
    }
    static void clear(std::array<VGfloat, 4> color) {
        vgSetfv(VG_CLEAR_COLOR, 4, color.data());
        vgClear(0, 0, 16384, 16384);
    }

    static VGPath newPath(VGPathDatatype type = VG_PATH_DATATYPE_F, VGfloat scale = 1, VGfloat bias = 0) {
        return vgCreatePath(VG_PATH_FORMAT_STANDARD, type, scale, bias, 0, 0, VG_PATH_CAPABILITY_ALL);
    }
    static VGPath newPath(std::initializer_list<VGubyte> commands, std::initializer_list<VGfloat> numbers) {
        const VGPath path = newPath();
        append(path, commands, numbers);
        return path;
    }
    static void append(VGPath path, std::initializer_list<VGubyte> commands,
                       std::initializer_list<VGfloat> numbers) {
        vgAppendPathData(path, VGint(commands.size()), commands.begin(), numbers.begin());
    }
    static VGPath rectangle(VGfloat x, VGfloat y, VGfloat width, VGfloat height) {
        const VGPath path = newPath();
        vguRect(path, x, y, width, height);
        return path;
    }
    static VGPaint newPaint(std::array<VGfloat, 4> color) {
        const VGPaint paint = vgCreatePaint();
        vgSetParameterfv(paint, VG_PAINT_COLOR, 4, color.data());
        return paint;
    }
    static VGImage newImage(VGImageFormat format, int width, int height) {
        return vgCreateImage(
            format, width, height,
            VG_IMAGE_QUALITY_NONANTIALIASED | VG_IMAGE_QUALITY_FASTER | VG_IMAGE_QUALITY_BETTER);
    }
    /// VG_sRGBA_8888, one row of it.
    static VGImage newImage(std::initializer_list<Rgba> pixels, VGImageFormat format = VG_sRGBA_8888) {
        const VGImage image = newImage(format, int(pixels.size()), 1);
        std::vector<std::uint32_t> words;
        for (const Rgba& c : pixels)
            words.push_back(wordOf(c));
        vgImageSubData(image, words.data(), 0, format, 0, 0, VGint(words.size()), 1);
        return image;
    }
    static Rgba texel(VGImage image, int x, int y, VGImageFormat format = VG_sRGBA_8888) {
        std::uint32_t word = 0;
        vgGetImageSubData(image, &word, 4, format, x, y, 1, 1);
        return rgbaOf(word);
    }

    VtmContext* context;
    VtmSurface* surface;
};

inline ::testing::AssertionResult isNear(Rgba a, Rgba b, int tolerance) {
    for (std::size_t c = 0; c < 4; ++c)
        if (std::abs(a[c] - b[c]) > tolerance)
            return ::testing::AssertionFailure() << ::testing::PrintToString(a) << " is not "
                                                 << ::testing::PrintToString(b) << " within " << tolerance;
    return ::testing::AssertionSuccess();
}

}  // namespace vtm::openvg::testing

/// The call gives exactly this error.
#define EXPECT_VG_ERROR(code, ...)                     \
    do {                                               \
        vgGetError();                                  \
        static_cast<void>(__VA_ARGS__);                \
        EXPECT_EQ(vgGetError(), code) << #__VA_ARGS__; \
    } while (false)
