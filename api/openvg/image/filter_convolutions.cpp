// Section 12.4: convolutions with kernels that programs give.

#include <algorithm>
#include <array>
#include <numeric>

#include "api/openvg/image/filter_images.hpp"

using namespace vtm::openvg;

namespace {

/// Weights of the source pixels at x + offset, x + offset + 1, ….
struct Kernel {
    std::vector<double> weights;
    int offset = 0;

    Kernel(const VGshort* values, VGint count, VGint shift)
        : weights(std::size_t(count)), offset(-std::clamp(shift, -(1 << 28), 1 << 28)) {
        // Index count - i - 1: the kernel is turned round.
        for (VGint i = 0; i < count; ++i)
            weights[std::size_t(i)] = double(values[count - i - 1]);
    }
    std::vector<int> places(int count, int size, VGTilingMode mode) const {
        return tiledPlaces(offset, offset + count + int(weights.size()) - 1, size, mode);
    }
};

/// In doubles: kernels may cancel what they magnify.
using Sum = glm::dvec4;

/// sums[i] = Σ weights[k] * taps[k][i].
void weightedSums(std::span<const Sum* const> taps, std::span<const double> weights, std::span<Sum> sums) {
    for (std::size_t i = 0; i < sums.size(); ++i) {
        Sum sum(0);
        for (std::size_t k = 0; k < taps.size(); ++k)
            sum += weights[k] * taps[k][i];
        sums[i] = sum;
    }
}

/// One dimension after the other, only what is written.
void separable(Context& context, const FilterImages& images, const Kernel& across, const Kernel& up,
               double scale, double bias, VGTilingMode mode) {
    const ColorSpace space = filterSpace(context.state);
    const Color fill = tileFillColor(context.state, space);
    const int width = images.width(), height = images.height(), sourceHeight = images.src->height();
    const std::vector<int> columns = across.places(width, images.src->width(), mode),
                           lines = up.places(height, sourceHeight, mode);
    // Sums across: of all rows of the source, and of one of nothing but the fill colour.
    const auto size = std::size_t(width);
    std::vector<Sum> rows(size * std::size_t(sourceHeight)), fillRow(size), line(columns.size());
    std::fill(fillRow.begin(), fillRow.end(),
              Sum(fill) * std::accumulate(across.weights.begin(), across.weights.end(), 0.0));
    std::vector<const Sum*> taps;
    for (std::size_t k = 0; k < across.weights.size(); ++k)
        taps.push_back(line.data() + k);
    std::vector<Color> colors(std::size_t(images.src->width()));
    for (int y = 0; y < sourceHeight; ++y) {
        normalizedRow(*images.src, y, space, colors);
        for (std::size_t i = 0; i < line.size(); ++i)
            line[i] = Sum(columns[i] < 0 ? fill : colors[std::size_t(columns[i])]);
        weightedSums(taps, across.weights, std::span(rows).subspan(size * std::size_t(y), size));
    }
    std::vector<Sum> sums(size);
    colors.resize(size);
    for (int y = 0; y < height; ++y) {
        taps.clear();
        for (std::size_t k = 0; k < up.weights.size(); ++k) {
            const int j = lines[std::size_t(y) + k];
            taps.push_back(j < 0 ? fillRow.data() : rows.data() + size * std::size_t(j));
        }
        weightedSums(taps, up.weights, sums);
        for (std::size_t x = 0; x < size; ++x)
            colors[x] = Color(sums[x] * scale + bias);
        writeFilteredRow(context.state, *images.dst, y, colors, space);
    }
}

}  // namespace

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
                  low = -std::clamp(shiftY, -(1 << 28), 1 << 28), width = images.width();
        const std::vector<int> columns =
            tiledPlaces(left, left + width + kernelWidth - 1, source.width, tilingMode);
        std::vector<Color> colors(std::size_t(width), Color(0));
        for (int y = 0; y < images.height(); ++y) {
            const std::vector<int> rows =
                tiledPlaces(y + low, y + low + kernelHeight, source.height, tilingMode);
            for (int x = 0; x < width; ++x) {
                Sum sum(0);
                for (int i = 0; i < kernelWidth; ++i) {
                    const int u = columns[std::size_t(x + i)];
                    for (int j = 0; j < kernelHeight; ++j) {
                        const int v = rows[std::size_t(j)];
                        const double k = kernel[(kernelWidth - i - 1) * kernelHeight + kernelHeight - j - 1];
                        sum += k * Sum(u < 0 || v < 0 ? fill : source.at(u, v));
                    }
                }
                colors[std::size_t(x)] = Color(sum * double(scale) + double(bias));
            }
            writeFilteredRow(context.state, *images.dst, y, colors, space);
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
        separable(context, images, Kernel(kernelX, kernelWidth, shiftX),
                  Kernel(kernelY, kernelHeight, shiftY), double(scale), double(bias), tilingMode);
    });
}
