// Images whose pixels are in textures: what changes and filters them does the same there as in memory.

#include "api/openvg/tests/fixture.hpp"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>

namespace vtm::openvg::testing {
namespace {

using Bytes = std::vector<std::uint8_t>;

struct Format {
    VGImageFormat name;
    int bytes;
};
/// Of eight bits a channel, which are compared by channel.
constexpr std::array<Format, 9> formats{{{VG_sRGBA_8888, 4},
                                         {VG_sABGR_8888_PRE, 4},
                                         {VG_lRGBA_8888, 4},
                                         {VG_lARGB_8888_PRE, 4},
                                         {VG_sRGBX_8888, 4},
                                         {VG_lXBGR_8888, 4},
                                         {VG_sL_8, 1},
                                         {VG_lL_8, 1},
                                         {VG_A_8, 1}}};

class ImagesInTextures : public VgTest {
protected:
    static constexpr int side = 40;

    ImagesInTextures() : VgTest(side, side) {}
    void SetUp() override {
        if (vtmChooseCompositor(surface, VTM_COMPOSITOR_GL) != VTM_COMPOSITOR_GL)
            GTEST_SKIP() << "no OpenGL ES 3: " << vtmGetCompositorFault();
    }

    int below(int end) { return int(random_() % unsigned(end)); }
    VGfloat unit() { return VGfloat(below(257)) / 256; }
    VGboolean flag() { return VGboolean(below(2)); }
    VGTilingMode tiling() { return VGTilingMode(VG_TILE_FILL + below(4)); }

    /// Random pixels, some of them transparent, some opaque. `inTexture`: where shaders draw, they are in
    /// one.
    VGImage image(const Format& format, int width, int height, bool inTexture) {
        const VGImage image = vgCreateImage(format.name, width, height, VG_IMAGE_QUALITY_NONANTIALIASED);
        std::vector<std::uint32_t> words(std::size_t(width * height));
        for (std::uint32_t& word : words)
            word = below(4) == 0 ? std::uint32_t(random_()) & ~255u : std::uint32_t(random_());
        vgImageSubData(image, words.data(), 4 * width, VG_sRGBA_8888, 0, 0, width, height);
        if (inTexture) {
            vgSetPixels(0, 0, image, 0, 0, width, height);
            vgFinish();
        }
        return image;
    }

    static Bytes pixelsOf(VGImage image, const Format& format) {
        const int width = vgGetParameteri(image, VG_IMAGE_WIDTH),
                  height = vgGetParameteri(image, VG_IMAGE_HEIGHT);
        Bytes bytes(std::size_t(width * height * format.bytes));
        vgGetImageSubData(image, bytes.data(), width * format.bytes, format.name, 0, 0, width, height);
        return bytes;
    }

    static int difference(const Bytes& a, const Bytes& b) {
        int largest = a.size() == b.size() ? 0 : 256;
        for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
            largest = std::max(largest, std::abs(int(a[i]) - int(b[i])));
        return largest;
    }

    /// What a call makes of the second image, which may be a part of a larger one, or a part of the first
    /// one's.
    using Call = std::function<void(VGImage dst, VGImage src)>;
    void expectTheSame(unsigned seed, const std::string& what, const Call& call) {
        std::array<Bytes, 2> results;
        const std::array compositors{VTM_COMPOSITOR_CPU, VTM_COMPOSITOR_GL};
        for (std::size_t i = 0; i < results.size(); ++i) {
            random_.seed(seed);
            vtmChooseCompositor(surface, compositors[i]);
            const Format from = formats[std::size_t(below(int(formats.size())))],
                         to = formats[std::size_t(below(int(formats.size())))];
            const bool isOne = below(4) == 0, isChild = below(3) == 0, dstInTexture = below(2) == 0;
            VGImage src = image(from, 10 + below(30), 10 + below(30), true), dst = src;
            if (!isOne)
                dst = image(to, 5 + below(35), 5 + below(35), dstInTexture);
            VGImage srcPart = src, dstPart = dst;
            if (isOne || isChild) {
                srcPart = vgChildImage(src, 1, 2, 4 + below(2), 7);
                dstPart = vgChildImage(dst, isOne ? 6 : 1, 0, 4, 5);
            }
            call(dstPart, srcPart);
            EXPECT_EQ(vgGetError(), VG_NO_ERROR) << what << ", seed " << seed;
            results[i] = pixelsOf(dst, isOne ? from : to);
            for (const VGImage used : {srcPart, dstPart, src, dst})
                vgDestroyImage(used);
            vgGetError();
        }
        EXPECT_LE(difference(results[0], results[1]), 1) << what << ", seed " << seed;
    }

    void setFilterState() {
        vgSeti(VG_FILTER_FORMAT_LINEAR, flag());
        vgSeti(VG_FILTER_FORMAT_PREMULTIPLIED, flag());
        vgSeti(VG_FILTER_CHANNEL_MASK, below(2) == 0 ? 15 : below(16));
        const std::array<VGfloat, 4> fill{unit(), unit(), unit(), unit()};
        vgSetfv(VG_TILE_FILL_COLOR, 4, fill.data());
        vgSetfv(VG_CLEAR_COLOR, 4, fill.data());
    }

    std::mt19937 random_;
};

constexpr unsigned rounds = 60;

TEST_F(ImagesInTextures, AreCleared) {
    for (unsigned seed = 0; seed < rounds; ++seed)
        expectTheSame(seed, "vgClearImage", [&](VGImage dst, VGImage) {
            setFilterState();
            vgClearImage(dst, below(9) - 4, below(9) - 4, 1 + below(20), 1 + below(20));
        });
}

TEST_F(ImagesInTextures, AreCopied) {
    for (unsigned seed = 0; seed < rounds; ++seed)
        expectTheSame(seed, "vgCopyImage", [&](VGImage dst, VGImage src) {
            vgCopyImage(dst, below(9) - 4, below(9) - 4, src, below(9) - 4, below(9) - 4, 1 + below(20),
                        1 + below(20), VG_FALSE);
            vgCopyImage(dst, below(3), below(3), dst, below(3), below(3), 9, 9, VG_FALSE);
        });
}

TEST_F(ImagesInTextures, AreWrittenAndReadInPart) {
    for (unsigned seed = 0; seed < rounds; ++seed)
        expectTheSame(seed, "vgImageSubData", [&](VGImage dst, VGImage src) {
            constexpr int part = 9;
            std::array<std::uint32_t, part * part> words{};
            vgGetImageSubData(src, words.data(), 4 * part, VG_sRGBA_8888, below(5) - 2, below(5) - 2, part,
                              part);
            vgImageSubData(dst, words.data(), 4 * part, below(2) ? VG_lBGRA_8888_PRE : VG_sRGBA_8888,
                           below(5) - 2, below(5) - 2, part, part);
        });
}

TEST_F(ImagesInTextures, AreFilteredByMatrices) {
    for (unsigned seed = 0; seed < rounds; ++seed)
        expectTheSame(seed, "vgColorMatrix", [&](VGImage dst, VGImage src) {
            setFilterState();
            std::array<VGfloat, 20> matrix;
            for (VGfloat& v : matrix)
                v = 1.5f * unit() - 0.5f;
            vgColorMatrix(dst, src, matrix.data());
        });
}

TEST_F(ImagesInTextures, AreFilteredByTables) {
    for (unsigned seed = 0; seed < 2 * rounds; ++seed)
        expectTheSame(seed, "vgLookup, vgLookupSingle", [&](VGImage dst, VGImage src) {
            setFilterState();
            std::array<std::array<VGubyte, 256>, 4> tables;
            for (auto& table : tables)
                for (VGubyte& v : table)
                    v = VGubyte(random_());
            std::array<VGuint, 256> colors;
            for (VGuint& v : colors)
                v = VGuint(random_());
            if (seed % 2 == 0)
                vgLookup(dst, src, tables[0].data(), tables[1].data(), tables[2].data(), tables[3].data(),
                         flag(), flag());
            else
                vgLookupSingle(dst, src, colors.data(), VGImageChannel(1 << below(4)), flag(), flag());
        });
}

TEST_F(ImagesInTextures, AreConvolved) {
    for (unsigned seed = 0; seed < 2 * rounds; ++seed)
        expectTheSame(seed, "vgConvolve, vgSeparableConvolve", [&](VGImage dst, VGImage src) {
            setFilterState();
            const int width = 1 + below(7), height = 1 + below(7);
            std::array<VGshort, 49> kernel;
            VGfloat sum = 1;
            for (VGshort& v : kernel) {
                v = VGshort(below(31) - 10);
                sum += VGfloat(std::abs(v));
            }
            const VGint x = below(11) - 4, y = below(11) - 4;
            const VGfloat scale = (seed % 4 == 0 ? 4 : 1) / sum, bias = unit() / 4;
            if (seed % 2 == 0)
                vgConvolve(dst, src, width, height, x, y, kernel.data(), scale, bias, tiling());
            else
                vgSeparableConvolve(dst, src, width, height, x, y, kernel.data(), kernel.data() + 20,
                                    scale / 8, bias, tiling());
        });
}

TEST_F(ImagesInTextures, AreBlurred) {
    for (unsigned seed = 0; seed < rounds; ++seed)
        expectTheSame(seed, "vgGaussianBlur", [&](VGImage dst, VGImage src) {
            setFilterState();
            vgGaussianBlur(dst, src, 0.1f + 5 * unit(), 0.1f + (seed % 4 == 0 ? 40 : 3) * unit(), tiling());
        });
}

// What a program asks for again and again, without a look in between.
TEST_F(ImagesInTextures, GoOnWhereTheyAre) {
    std::array<Bytes, 2> results;
    const std::array compositors{VTM_COMPOSITOR_CPU, VTM_COMPOSITOR_GL};
    const Format format{VG_sRGBA_8888_PRE, 4};
    for (std::size_t i = 0; i < results.size(); ++i) {
        random_.seed(7);
        vtmChooseCompositor(surface, compositors[i]);
        const VGImage a = image(format, side, side, true), b = image(format, side, side, true);
        for (int k = 0; k < 6; ++k) {
            vgGaussianBlur(b, a, 1.5f, 1, VG_TILE_REFLECT);
            vgCopyImage(a, 3, 5, b, 0, 0, 30, 30, VG_FALSE);
            vgDrawImage(b);
            vgGetPixels(a, 0, 0, 10, 10, 20, 20);
        }
        results[i] = pixelsOf(a, format);
        vgDestroyImage(a);
        vgDestroyImage(b);
    }
    EXPECT_LE(difference(results[0], results[1]), 2);
}

}  // namespace
}  // namespace vtm::openvg::testing
