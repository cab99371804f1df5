// Section 12: image filters.

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "api/openvg/image/filter_images.hpp"

using namespace vtm::openvg;

namespace {

/// Weights of the source pixels at x + offset, x + offset + 1, ….
struct Kernel {
    std::vector<double> weights;
    int offset = 0;
};

/// One dimension after the other, only what is written.
void separable(Context& context, const FilterImages& images, const Kernel& across, const Kernel& up,
               double scale, double bias, VGTilingMode mode) {
    const ColorSpace space = filterSpace(context.state);
    const Raster source = normalized(*images.src, space);
    const Color fill = tileFillColor(context.state, space);
    using Sum = glm::dvec4;
    const int width = images.width(), height = images.height();
    // Rows of sums across: all rows of the source, and one of nothing but the fill colour.
    std::vector<Sum> rows(std::size_t(width) * std::size_t(source.height));
    Sum fillRow(0);
    for (const double w : across.weights)
        fillRow += w * Sum(fill);
    for (int y = 0; y < source.height; ++y)
        for (int x = 0; x < width; ++x) {
            Sum sum(0);
            for (std::size_t k = 0; k < across.weights.size(); ++k) {
                const int i = tiled(x + across.offset + int(k), source.width, mode);
                sum += across.weights[k] * Sum(i < 0 ? fill : source.at(i, y));
            }
            rows[std::size_t(y) * std::size_t(width) + std::size_t(x)] = sum;
        }
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            Sum sum(0);
            for (std::size_t k = 0; k < up.weights.size(); ++k) {
                const int j = tiled(y + up.offset + int(k), source.height, mode);
                sum += up.weights[k] *
                       (j < 0 ? fillRow : rows[std::size_t(j) * std::size_t(width) + std::size_t(x)]);
            }
            writeFiltered(context.state, *images.dst, x, y, Color(sum * scale + bias), space);
        }
}

Kernel kernelOf(const VGshort* values, VGint count, VGint shift) {
    Kernel kernel;
    kernel.weights.resize(std::size_t(count));
    // Index count - i - 1: the kernel is turned round.
    for (VGint i = 0; i < count; ++i)
        kernel.weights[std::size_t(i)] = double(values[count - i - 1]);
    kernel.offset = -std::clamp(shift, -(1 << 28), 1 << 28);
    return kernel;
}

Kernel gaussian(double deviation) {
    // What lies beyond is less than 1e-5 of the whole.
    const int reach = int(std::ceil(4.5 * deviation));
    Kernel kernel;
    kernel.offset = -reach;
    double sum = 0;
    for (int i = -reach; i <= reach; ++i) {
        const double q = i / deviation;
        kernel.weights.push_back(std::exp(-q * q / 2));
        sum += kernel.weights.back();
    }
    for (double& w : kernel.weights)
        w /= sum;
    return kernel;
}

std::size_t tableIndex(float channel) { return std::size_t(std::clamp(channel, 0.0f, 1.0f) * 255 + 0.5f); }

}  // namespace

void vgColorMatrix(VGImage dst, VGImage src, const VGfloat* matrix) {
    call([&](Context& context) {
        const FilterImages images(context, dst, src);
        require(matrix != nullptr && isAligned(matrix));
        glm::mat4 m;
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 4; ++r)
                m[c][r] = matrix[4 * c + r];
        const Color added(matrix[16], matrix[17], matrix[18], matrix[19]);
        const ColorSpace space = filterSpace(context.state);
        for (int y = 0; y < images.height(); ++y)
            for (int x = 0; x < images.width(); ++x)
                writeFiltered(
                    context.state, *images.dst, x, y,
                    m * normalized(images.src->color(x, y), images.src->format().space, space) + added,
                    space);
    });
}

void vgConvolve(VGImage dst, VGImage src, VGint kernelWidth, VGint kernelHeight, VGint shiftX, VGint shiftY,
                const VGshort* kernel, VGfloat scale, VGfloat bias, VGTilingMode tilingMode) {
    call([&](Context& context) {
        const FilterImages images(context, dst, src);
        require(kernelWidth > 0 && kernelHeight > 0 && kernelWidth <= maxKernelSize &&
                kernelHeight <= maxKernelSize);
        require(kernel != nullptr && isAligned(kernel) && isTiling(tilingMode));
        const ColorSpace space = filterSpace(context.state);
        const Raster source = normalized(*images.src, space);
        const Color fill = tileFillColor(context.state, space);
        const int left = -std::clamp(shiftX, -(1 << 28), 1 << 28),
                  low = -std::clamp(shiftY, -(1 << 28), 1 << 28);
        for (int y = 0; y < images.height(); ++y)
            for (int x = 0; x < images.width(); ++x) {
                glm::dvec4 sum(0);
                for (int i = 0; i < kernelWidth; ++i) {
                    const int u = tiled(x + left + i, source.width, tilingMode);
                    for (int j = 0; j < kernelHeight; ++j) {
                        const int v = tiled(y + low + j, source.height, tilingMode);
                        const double k = kernel[(kernelWidth - i - 1) * kernelHeight + kernelHeight - j - 1];
                        sum += k * glm::dvec4(u < 0 || v < 0 ? fill : source.at(u, v));
                    }
                }
                writeFiltered(context.state, *images.dst, x, y, Color(sum * double(scale) + double(bias)),
                              space);
            }
    });
}

void vgSeparableConvolve(VGImage dst, VGImage src, VGint kernelWidth, VGint kernelHeight, VGint shiftX,
                         VGint shiftY, const VGshort* kernelX, const VGshort* kernelY, VGfloat scale,
                         VGfloat bias, VGTilingMode tilingMode) {
    call([&](Context& context) {
        const FilterImages images(context, dst, src);
        require(kernelWidth > 0 && kernelHeight > 0 && kernelWidth <= maxSeparableKernelSize &&
                kernelHeight <= maxSeparableKernelSize);
        require(kernelX != nullptr && isAligned(kernelX) && kernelY != nullptr && isAligned(kernelY));
        require(isTiling(tilingMode));
        separable(context, images, kernelOf(kernelX, kernelWidth, shiftX),
                  kernelOf(kernelY, kernelHeight, shiftY), double(scale), double(bias), tilingMode);
    });
}

void vgGaussianBlur(VGImage dst, VGImage src, VGfloat stdDeviationX, VGfloat stdDeviationY,
                    VGTilingMode tilingMode) {
    call([&](Context& context) {
        const FilterImages images(context, dst, src);
        for (const VGfloat deviation : {stdDeviationX, stdDeviationY})
            require(deviation > 0 && deviation <= VGfloat(maxGaussianStdDeviation));
        require(isTiling(tilingMode));
        separable(context, images, gaussian(double(stdDeviationX)), gaussian(double(stdDeviationY)), 1, 0,
                  tilingMode);
    });
}

void vgLookup(VGImage dst, VGImage src, const VGubyte* redLUT, const VGubyte* greenLUT,
              const VGubyte* blueLUT, const VGubyte* alphaLUT, VGboolean outputLinear,
              VGboolean outputPremultiplied) {
    call([&](Context& context) {
        const FilterImages images(context, dst, src);
        const std::array<const VGubyte*, 4> tables{redLUT, greenLUT, blueLUT, alphaLUT};
        for (const VGubyte* table : tables)
            require(table != nullptr);
        const ColorSpace space = filterSpace(context.state);
        const ColorSpace output{outputLinear != VG_FALSE, outputPremultiplied != VG_FALSE, false};
        for (int y = 0; y < images.height(); ++y)
            for (int x = 0; x < images.width(); ++x) {
                const Color in = normalized(images.src->color(x, y), images.src->format().space, space);
                Color out;
                for (int c = 0; c < 4; ++c)
                    out[c] = float(tables[std::size_t(c)][tableIndex(in[c])]) / 255;
                writeFiltered(context.state, *images.dst, x, y, out, output);
            }
    });
}

void vgLookupSingle(VGImage dst, VGImage src, const VGuint* lookupTable, VGImageChannel sourceChannel,
                    VGboolean outputLinear, VGboolean outputPremultiplied) {
    call([&](Context& context) {
        const FilterImages images(context, dst, src);
        require(lookupTable != nullptr && isAligned(lookupTable));
        const PixelFormat& format = images.src->format();
        int channel = 0;
        if (format.grey.bits == 0 && format.red.bits == 0) {
            channel = 3;
        } else if (format.grey.bits == 0) {
            require(sourceChannel == VG_RED || sourceChannel == VG_GREEN || sourceChannel == VG_BLUE ||
                    sourceChannel == VG_ALPHA);
            channel = sourceChannel == VG_RED     ? 0
                      : sourceChannel == VG_GREEN ? 1
                      : sourceChannel == VG_BLUE  ? 2
                                                  : 3;
        }
        const ColorSpace space = filterSpace(context.state);
        const ColorSpace output{outputLinear != VG_FALSE, outputPremultiplied != VG_FALSE, false};
        for (int y = 0; y < images.height(); ++y)
            for (int x = 0; x < images.width(); ++x) {
                const Color in = normalized(images.src->color(x, y), format.space, space);
                const VGuint entry = lookupTable[tableIndex(in[channel])];
                const Color out(float(entry >> 24), float((entry >> 16) & 255), float((entry >> 8) & 255),
                                float(entry & 255));
                writeFiltered(context.state, *images.dst, x, y, out / 255.0f, output);
            }
    });
}
