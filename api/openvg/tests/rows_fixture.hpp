/// \file
/// Surfaces, images and drawings at random, beside their twins.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "api/openvg/tests/fixture.hpp"
#include "api/openvg/tests/pixel_twin.hpp"

namespace vtm::openvg::testing {

inline constexpr std::array blendModes{
    VG_BLEND_SRC,      VG_BLEND_SRC_OVER, VG_BLEND_DST_OVER, VG_BLEND_SRC_IN,  VG_BLEND_DST_IN,
    VG_BLEND_MULTIPLY, VG_BLEND_SCREEN,   VG_BLEND_DARKEN,   VG_BLEND_LIGHTEN, VG_BLEND_ADDITIVE};

/// A surface, and the image format of the same channels.
struct SurfaceKind {
    VtmSurfaceFormat format;
    VGImageFormat name;
};
inline const std::array surfaces{SurfaceKind{{8, 8, 8, 8, 0, 8, VG_FALSE, VG_TRUE}, VG_sABGR_8888_PRE},
                                 SurfaceKind{{8, 8, 8, 8, 0, 8, VG_FALSE, VG_FALSE}, VG_sABGR_8888},
                                 SurfaceKind{{8, 8, 8, 8, 0, 8, VG_TRUE, VG_TRUE}, VG_lABGR_8888_PRE},
                                 SurfaceKind{{8, 8, 8, 8, 0, 8, VG_TRUE, VG_FALSE}, VG_lABGR_8888},
                                 SurfaceKind{{8, 8, 8, 0, 0, 8, VG_FALSE, VG_FALSE}, VG_sXBGR_8888},
                                 SurfaceKind{{5, 6, 5, 0, 0, 8, VG_FALSE, VG_FALSE}, VG_sRGB_565},
                                 SurfaceKind{{4, 4, 4, 4, 0, 8, VG_FALSE, VG_FALSE}, VG_sRGBA_4444},
                                 SurfaceKind{{0, 0, 0, 0, 8, 8, VG_FALSE, VG_FALSE}, VG_sL_8}};

class RowsTest : public VgTest {
protected:
    static constexpr int width = 150, height = 3;  ///< more than is worked on at a time

    RowsTest() : VgTest(width, height) {}

    int below(int end) { return int(random_() % unsigned(end)); }
    float unit() { return float(random_() & 0xffff) / 65535; }

    /// Random words that the format may hold; many alphas are 0 or the largest.
    TwinImage randomImage(VGImageFormat name, int w, int h) {
        TwinImage image(name, w, h);
        for (std::uint32_t& word : image.words) {
            Color c(unit(), unit(), unit(), below(3) == 0 ? float(below(2)) : unit());
            word = image.format.encode(image.format.space.premultiplied ? premultiplied(c) : c);
        }
        return image;
    }

    /// Magnifies an image of 90 × 70 pixels until the surface is inside of it, and turns it.
    glm::mat3 magnifying() {
        const float zoom = 3 + unit(), turn = 0.2f * unit(), c = zoom * std::cos(turn),
                    s = zoom * std::sin(turn);
        return {c, s, 0, -s, c, 0, -40 + 10 * unit(), -90 - unit(), 1};
    }
    static VGImage uploaded(const TwinImage& image) {
        const VGImage handle = newImage(image.name, image.width, image.height);
        vgImageSubData(handle, image.bytes().data(), image.stride(), image.name, 0, 0, image.width,
                       image.height);
        return handle;
    }
    static TwinImage read(VGImageFormat name) {
        TwinImage image(name, width, height);
        std::vector<std::uint8_t> bytes(std::size_t(image.stride() * height));
        vgReadPixels(bytes.data(), image.stride(), name, 0, 0, width, height);
        image.setBytes(bytes);
        return image;
    }

    /// A surface of random pixels, a random mask, transform and blend mode.
    TwinImage prepare(const SurfaceKind& kind, TwinDrawing& drawing) {
        useSurface(width, height, kind.format);
        const TwinImage before = randomImage(kind.name, width, height);
        vgWritePixels(before.bytes().data(), before.stride(), kind.name, 0, 0, width, height);
        drawing.blendMode = blendModes[std::size_t(below(int(blendModes.size())))];
        vgSeti(VG_BLEND_MODE, drawing.blendMode);
        const bool isTransformed = below(3) == 0, isMasked = below(3) == 0;
        vgSeti(VG_COLOR_TRANSFORM, isTransformed);
        if (isTransformed) {
            drawing.colorTransform.emplace();
            for (std::size_t i = 0; i < 8; ++i)
                (*drawing.colorTransform)[i] = i < 4 ? 2 * unit() : unit() - 0.5f;
            vgSetfv(VG_COLOR_TRANSFORM_VALUES, 8, drawing.colorTransform->data());
        }
        vgSeti(VG_MASKING, isMasked);
        if (isMasked) {
            const TwinImage mask = randomImage(VG_A_8, width, height);
            const VGImage image = uploaded(mask);
            vgMask(image, VG_SET_MASK, 0, 0, width, height);
            vgDestroyImage(image);
            drawing.coverage = [mask](int x, int y) { return float(mask.word(x, y)) / 255; };
        }
        return before;
    }

    void expectDrawn(const TwinImage& before, const TwinDrawing& drawing, const TwinSource& source,
                     const std::string& what) {
        const TwinImage after = read(before.name);
        int wrong = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const Color expected = drawing.drawn(before, source, x, y);
                if (!testing::isNear(before.format, after.word(x, y), expected) && ++wrong == 1) {
                    const Color is = after.color(x, y), was = before.color(x, y), s = source.color(x, y);
                    ADD_FAILURE() << what << ", surface " << std::hex << before.name << ", blend mode "
                                  << drawing.blendMode << std::dec << ", pixel " << x << " " << y << ": ("
                                  << is.r << " " << is.g << " " << is.b << " " << is.a << ") is not ("
                                  << expected.r << " " << expected.g << " " << expected.b << " " << expected.a
                                  << "), before (" << was.r << " " << was.g << " " << was.b << " " << was.a
                                  << "), source (" << s.r << " " << s.g << " " << s.b << " " << s.a
                                  << "), coverage " << drawing.coverage(x, y);
                }
            }
        EXPECT_EQ(wrong, 0) << what;
    }

    static void load(VGMatrixMode mode, const glm::mat3& m) {
        vgSeti(VG_MATRIX_MODE, mode);
        vgLoadMatrix(&m[0][0]);
    }
    static void draw(const TwinImage& image, const glm::mat3& toSurface) {
        const VGImage handle = uploaded(image);
        load(VG_MATRIX_IMAGE_USER_TO_SURFACE, toSurface);
        vgDrawImage(handle);
        vgDestroyImage(handle);
    }

    std::mt19937 random_{20070131};
};

}  // namespace vtm::openvg::testing
