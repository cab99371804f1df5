/// \file
/// What the tests of extensions share besides: bytes in and out of images and the surface, colours as
/// numbers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <VG/openvg.h>
#include <VG/vgext.h>
#include <VG/vgu.h>
#include <vtm/vg.h>

#include "api/openvg/tests/fixture.hpp"

namespace extensions {

/// Red, green, blue, alpha.
using Color = std::array<double, 4>;
using Bytes = std::vector<std::uint8_t>;

inline Color premultiplied(Color c) { return {c[0] * c[3], c[1] * c[3], c[2] * c[3], c[3]}; }
inline Color unpremultiplied(Color c) {
    return c[3] > 0 ? Color{c[0] / c[3], c[1] / c[3], c[2] / c[3], c[3]} : Color{};
}

/// The transfer functions of section 3.4.2 on colours without premultiplied alpha.
inline Color linear(Color c) {
    for (int i = 0; i < 3; ++i)
        c[std::size_t(i)] = c[std::size_t(i)] <= 0.03928
                                ? c[std::size_t(i)] / 12.92
                                : std::pow((c[std::size_t(i)] + 0.0556) / 1.0556, 2.4);
    return c;
}
inline Color nonlinear(Color c) {
    for (int i = 0; i < 3; ++i)
        c[std::size_t(i)] = c[std::size_t(i)] <= 0.00304
                                ? 12.92 * c[std::size_t(i)]
                                : 1.0556 * std::pow(c[std::size_t(i)], 1 / 2.4) - 0.0556;
    return c;
}

inline Color colorAt(const Bytes& bytes, int pixel) {
    Color color;
    for (std::size_t c = 0; c < 4; ++c)
        color[c] = bytes[std::size_t(pixel) * 4 + c] / 255.0;
    return color;
}

/// 255 times a number is a byte, but for rounding to nearest and `slack` of a step.
inline void expectByte(double number, int byte, double slack = 0.02) {
    EXPECT_NEAR(number * 255, byte, 0.5 + slack);
}

/// Formats whose bytes in memory are red, green, blue, alpha.
inline constexpr auto sRGBA = VGImageFormat(VG_sABGR_8888), sRGBA_PRE = VGImageFormat(VG_sABGR_8888_PRE),
                      lRGBA = VGImageFormat(VG_lABGR_8888), lRGBA_PRE = VGImageFormat(VG_lABGR_8888_PRE);

/// A premultiplied sRGB surface of `side` times `side` pixels; row 0 is at the bottom.
class Extensions : public vtm::openvg::testing::VgTest {
protected:
    static constexpr int side = 32;

    Extensions() : VgTest(side, side, {8, 8, 8, 8, 0, 0, VG_FALSE, VG_TRUE}) {}

    void SetUp() override {
        vgSeti(VG_RENDERING_QUALITY, VG_RENDERING_QUALITY_NONANTIALIASED);
        vgSeti(VG_IMAGE_QUALITY, VG_IMAGE_QUALITY_NONANTIALIASED);
    }
    void TearDown() override { EXPECT_EQ(vgGetError(), VG_NO_ERROR); }

    static bool has(const char* extension) {
        const std::string all = std::string(reinterpret_cast<const char*>(vgGetString(VG_EXTENSIONS))) + " ";
        return all.find(std::string(extension) + " ") != std::string::npos;
    }

    /// The same bytes in every run.
    Bytes noise(std::size_t count) {
        Bytes bytes(count);
        for (std::uint8_t& b : bytes)
            b = std::uint8_t(random_());
        return bytes;
    }
    /// Four channels, none above alpha.
    Bytes premultipliedNoise(std::size_t pixels) {
        Bytes bytes = noise(pixels * 4);
        for (std::size_t i = 0; i < bytes.size(); ++i)
            bytes[i] = std::min(bytes[i], bytes[i | 3]);
        return bytes;
    }

    static VGImage image(VGImageFormat format, int width, int height, const Bytes& bytes) {
        const VGImage image = vgCreateImage(format, width, height, VG_IMAGE_QUALITY_NONANTIALIASED);
        const auto pixelBytes = VGint(bytes.size()) / (width * height);
        vgImageSubData(image, bytes.data(), width * pixelBytes, format, 0, 0, width, height);
        return image;
    }
    static Bytes bytesOf(VGImage image, VGImageFormat format) {
        const VGint width = vgGetParameteri(image, VG_IMAGE_WIDTH),
                    height = vgGetParameteri(image, VG_IMAGE_HEIGHT), pixelBytes = format == VG_A_8 ? 1 : 4;
        Bytes bytes(std::size_t(width * height * pixelBytes));
        vgGetImageSubData(image, bytes.data(), width * pixelBytes, format, 0, 0, width, height);
        return bytes;
    }
    static Bytes surfaceBytes() {
        Bytes bytes(std::size_t(side) * side * 4);
        vgReadPixels(bytes.data(), side * 4, sRGBA_PRE, 0, 0, side, side);
        return bytes;
    }

    /// Covers the surface with the current paint.
    static void fillSurface() {
        const VGPath path = rectangle(0, 0, side, side);
        vgDrawPath(path, VG_FILL_PATH);
        vgDestroyPath(path);
    }

private:
    std::mt19937 random_{1};
};

}  // namespace extensions
