// VG_KHR_iterative_average_blur against its definition: powers of a polynomial as separable kernels.

#include "api/openvg/tests/extensions_fixture.hpp"

namespace extensions {
namespace {

constexpr auto maxDimension = VGParamType(VG_MAX_AVERAGE_BLUR_DIMENSION_KHR),
               resolution = VGParamType(VG_AVERAGE_BLUR_DIMENSION_RESOLUTION_KHR),
               maxIterations = VGParamType(VG_MAX_AVERAGE_BLUR_ITERATIONS_KHR);

struct Kernel {
    std::vector<double> weights;  ///< of -reach to reach
    int reach = 0;
};

/// tap(i) of the extension's text, for dimensions of a pixel or more.
Kernel taps(double dimension) {
    const double radius = (dimension - 1) / 2;
    Kernel kernel;
    kernel.reach = int(std::trunc(1 + radius));
    for (int i = -kernel.reach; i <= kernel.reach; ++i)
        kernel.weights.push_back((std::abs(i) == kernel.reach ? radius - std::trunc(radius) : 1) / dimension);
    return kernel;
}

Kernel product(const Kernel& a, const Kernel& b) {
    Kernel result;
    result.reach = a.reach + b.reach;
    result.weights.assign(a.weights.size() + b.weights.size() - 1, 0);
    for (std::size_t i = 0; i < a.weights.size(); ++i)
        for (std::size_t j = 0; j < b.weights.size(); ++j)
            result.weights[i + j] += a.weights[i] * b.weights[j];
    return result;
}

Kernel power(double dimension, unsigned exponent) {
    Kernel result{{1}, 0};
    for (unsigned i = 0; i < exponent; ++i)
        result = product(result, taps(dimension));
    return result;
}

/// Where section 9.4.1 finds the pixel at i of a line of `size`; -1: nowhere.
int place(int i, int size, VGTilingMode mode) {
    while (i < 0 || i >= size) {
        if (mode == VG_TILE_FILL)
            return -1;
        if (mode == VG_TILE_PAD)
            i += i < 0 ? 1 : -1;
        else if (mode == VG_TILE_REPEAT)
            i += i < 0 ? size : -size;
        else
            i = i < 0 ? -1 - i : 2 * size - 1 - i;
    }
    return i;
}

class AverageBlur : public Extensions {
protected:
    static constexpr int width = 11, height = 7;

    void SetUp() override {
        Extensions::SetUp();
        // Without knowing of extensions, a program has no such parameter (section 15).
        EXPECT_EQ(vgGeti(maxDimension), 0);
        EXPECT_EQ(vgGetError(), VG_ILLEGAL_ARGUMENT_ERROR);
        vgGetString(VG_EXTENSIONS);
        const float fill[] = {0.25f, 0.5f, 0.75f, 1};
        vgSetfv(VG_TILE_FILL_COLOR, 4, fill);
    }

    /// Blurs an image whose numbers are the filter's, and compares with the plain sum; the result is
    /// `written` pixels wide.
    void check(double dimX, double dimY, unsigned iterations, VGTilingMode mode, int written = width) {
        SCOPED_TRACE(testing::Message() << dimX << " " << dimY << " " << iterations << " " << mode);
        const Bytes bytes = noise(width * height * 4);
        const VGImage src = image(sRGBA, width, height, bytes),
                      dst = image(sRGBA, written, height, Bytes(std::size_t(written * height * 4)));
        vgIterativeAverageBlurKHR(dst, src, float(dimX), float(dimY), iterations, mode);
        const Bytes result = bytesOf(dst, sRGBA);
        const Kernel across = power(dimX, iterations), up = power(dimY, iterations);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < written && !HasFailure(); ++x) {
                Color sum{};
                for (int j = -up.reach; j <= up.reach; ++j)
                    for (int i = -across.reach; i <= across.reach; ++i) {
                        const int u = place(x + i, width, mode), v = place(y + j, height, mode);
                        const Color color =
                            u < 0 || v < 0 ? Color{0.25, 0.5, 0.75, 1} : colorAt(bytes, v * width + u);
                        for (std::size_t c = 0; c < 4; ++c)
                            sum[c] += across.weights[std::size_t(i + across.reach)] *
                                      up.weights[std::size_t(j + up.reach)] * color[c];
                    }
                for (std::size_t c = 0; c < 4; ++c)
                    expectByte(sum[c], result[std::size_t(y * written + x) * 4 + c]);
            }
        vgDestroyImage(src);
        vgDestroyImage(dst);
    }
};

TEST_F(AverageBlur, IsNamedWithItsLimits) {
    EXPECT_TRUE(has("VG_KHR_iterative_average_blur"));
    EXPECT_GE(vgGeti(maxDimension), 128);
    EXPECT_EQ(vgGeti(resolution), -1);
    EXPECT_GE(vgGeti(maxIterations), 3);
    vgSeti(maxIterations, 1);  // no error, no effect (section 5.2)
    EXPECT_GE(vgGeti(maxIterations), 3);
    EXPECT_EQ(vtmGetProcAddress("vgIterativeAverageBlurKHR"), VtmFunction(&vgIterativeAverageBlurKHR));
}

TEST_F(AverageBlur, IsAPowerOfABox) {
    for (const VGTilingMode mode : {VG_TILE_FILL, VG_TILE_PAD, VG_TILE_REPEAT, VG_TILE_REFLECT}) {
        check(1, 1, 1, mode);
        check(3, 5, 1, mode);
        check(2, 2.5, 2, mode);
        check(7.25, 1.5, 3, mode);
        check(1, 4, 4, mode);
        check(3.5, 3.5, 0, mode);
        check(6, 1.25, 2, mode, width - 4);
    }
    check(128, 100.5, 1, VG_TILE_REFLECT);
    check(3, 2, unsigned(vgGeti(maxIterations)), VG_TILE_REPEAT);
}

TEST_F(AverageBlur, LeavesAPixelOrLessAsItIs) {
    const Bytes bytes = noise(width * height * 4);
    const VGImage src = image(sRGBA, width, height, bytes),
                  dst = image(sRGBA, width, height, Bytes(bytes.size()));
    for (const float dimension : {0.0f, 0.3f, 1.0f}) {
        vgClearImage(dst, 0, 0, width, height);
        vgIterativeAverageBlurKHR(dst, src, dimension, dimension, 3, VG_TILE_FILL);
        EXPECT_EQ(bytesOf(dst, sRGBA), bytes);
    }
}

TEST_F(AverageBlur, FiltersInTheFilterFormat) {
    // Two pixels, one transparent: premultiplied linear light against numbers as they are.
    const Bytes bytes{200, 100, 50, 255, 0, 0, 0, 0, 0, 0, 0, 0};
    const VGImage src = image(sRGBA, 3, 1, bytes), dst = image(sRGBA, 3, 1, Bytes(12));
    vgSeti(VG_FILTER_FORMAT_LINEAR, VG_TRUE);
    vgSeti(VG_FILTER_FORMAT_PREMULTIPLIED, VG_TRUE);
    vgIterativeAverageBlurKHR(dst, src, 3, 1, 1, VG_TILE_PAD);
    const Bytes result = bytesOf(dst, sRGBA);
    for (int c = 0; c < 3; ++c)
        EXPECT_EQ(result[std::size_t(4 + c)], bytes[std::size_t(c)]);
    EXPECT_EQ(result[7], 85);
}

TEST_F(AverageBlur, WritesWhereBothImagesAreAndChannelsThatTheMaskNames) {
    const VGImage src = image(sRGBA, 2, 2, Bytes(16, 90)), dst = image(sRGBA, 3, 3, Bytes(36, 10));
    vgSeti(VG_FILTER_CHANNEL_MASK, VG_RED | VG_ALPHA);
    vgIterativeAverageBlurKHR(dst, src, 9, 9, 2, VG_TILE_REPEAT);
    const Bytes result = bytesOf(dst, sRGBA);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 3; ++x)
            for (int c = 0; c < 4; ++c)
                EXPECT_EQ(result[std::size_t(12 * y + 4 * x + c)], x < 2 && y < 2 && c % 3 == 0 ? 90 : 10);
}

TEST_F(AverageBlur, NamesErrors) {
    const VGImage src = image(sRGBA, 4, 4, Bytes(64)), dst = image(sRGBA, 4, 4, Bytes(64));
    const VGImage half = vgChildImage(src, 0, 0, 2, 4);
    const VGfloat maximum = vgGetf(maxDimension);
    const auto iterations = VGuint(vgGeti(maxIterations));
    const auto error = [&](VGImage to, VGImage from, VGfloat x, VGfloat y, VGuint n, VGTilingMode mode) {
        vgIterativeAverageBlurKHR(to, from, x, y, n, mode);
        return vgGetError();
    };
    EXPECT_EQ(error(dst, src, maximum, maximum, iterations, VG_TILE_FILL), VG_NO_ERROR);
    EXPECT_EQ(error(dst, VG_INVALID_HANDLE, 2, 2, 1, VG_TILE_PAD), VG_BAD_HANDLE_ERROR);
    EXPECT_EQ(error(dst + 100, src, 2, 2, 1, VG_TILE_PAD), VG_BAD_HANDLE_ERROR);
    EXPECT_EQ(error(half, src, 2, 2, 1, VG_TILE_PAD), VG_ILLEGAL_ARGUMENT_ERROR);
    EXPECT_EQ(error(dst, src, -1, 2, 1, VG_TILE_PAD), VG_ILLEGAL_ARGUMENT_ERROR);
    EXPECT_EQ(error(dst, src, 2, NAN, 1, VG_TILE_PAD), VG_ILLEGAL_ARGUMENT_ERROR);
    EXPECT_EQ(error(dst, src, 2, maximum + 1, 1, VG_TILE_PAD), VG_ILLEGAL_ARGUMENT_ERROR);
    EXPECT_EQ(error(dst, src, 2, 2, iterations + 1, VG_TILE_PAD), VG_ILLEGAL_ARGUMENT_ERROR);
    EXPECT_EQ(error(dst, src, 2, 2, 1, VGTilingMode(VG_TILE_REFLECT + 1)), VG_ILLEGAL_ARGUMENT_ERROR);
}

}  // namespace
}  // namespace extensions
