// Section 12.4: convolutions with kernels that programs give.

#include <algorithm>
#include <vector>

#include "api/openvg/image/filter_images.hpp"
#include "api/openvg/image/weighted_sums.hpp"

using namespace vtm::openvg;

namespace {

/// Of a kernel's first tap from the pixel.
int offsetOf(int shift) { return -std::clamp(shift, -(1 << 28), 1 << 28); }

/// What a kernel's taps fall on: columns or rows of the tiled source.
std::vector<int> placesOf(int kernelSize, int offset, int count, int size, VGTilingMode mode) {
    return tiledPlaces(offset, offset + count + kernelSize - 1, size, mode);
}

/// Kernels are turned round: the first weight is that of the first place.
std::vector<double> reversedWeights(const VGshort* values, VGint count) {
    return {std::reverse_iterator(values + count), std::reverse_iterator(values)};
}

/// Rows of the tiled source as numbers, the last ones of them that were asked for.
class SourceLines {
public:
    /// `across`: weights of a row's pixels from each one on, whose sums the rows are then; none: the pixels.
    SourceLines(const Image& image, const State& state, int count, std::vector<int> columns,
                std::vector<int> rows, std::vector<double> across = {})
        : image_(image),
          space_(filterSpace(state)),
          fill_(tileFillColor(state, space_)),
          columns_(std::move(columns)),
          rows_(std::move(rows)),
          across_(std::move(across)),
          colors_(std::size_t(image.width())),
          pixels_(columns_.size()),
          lines_(std::size_t(count)) {}

    /// Of the i-th place. Stays until as many others after it were asked for.
    const Sum* line(int i) {
        for (; made_ <= i; ++made_)
            make(rows_[std::size_t(made_)], kept(made_));
        return kept(i).data();
    }

private:
    std::vector<Sum>& kept(int i) { return lines_[std::size_t(i) % lines_.size()]; }

    void make(int row, std::vector<Sum>& line) {
        if (row >= 0)
            normalizedRow(image_, row, space_, colors_);
        for (std::size_t i = 0; i < pixels_.size(); ++i)
            pixels_[i] = Sum(row < 0 || columns_[i] < 0 ? fill_ : colors_[std::size_t(columns_[i])]);
        if (across_.empty()) {
            line = pixels_;
            return;
        }
        line.resize(pixels_.size() - across_.size() + 1);
        std::vector<const Sum*> taps;
        for (std::size_t k = 0; k < across_.size(); ++k)
            taps.push_back(pixels_.data() + k);
        weightedSums(taps, across_, line);
    }

    const Image& image_;
    const ColorSpace space_;
    const Color fill_;
    const std::vector<int> columns_, rows_;
    const std::vector<double> across_;
    std::vector<Color> colors_;
    std::vector<Sum> pixels_;
    std::vector<std::vector<Sum>> lines_;
    int made_ = 0;
};

/// Writes sums of `columns` places in each of as many lines as that takes for all weights.
void writeSums(const State& state, const FilterImages& images, SourceLines& source,
               std::span<const double> weights, int columns, double scale, double bias) {
    const ColorSpace space = filterSpace(state);
    std::vector<Sum> sums(std::size_t(images.width()));
    std::vector<Color> colors(sums.size());
    std::vector<const Sum*> taps(weights.size());
    for (int y = 0; y < images.height(); ++y) {
        for (int k = 0; k < int(weights.size()); ++k)
            taps[std::size_t(k)] = source.line(y + k / columns) + k % columns;
        weightedSums(taps, weights, sums);
        for (std::size_t x = 0; x < sums.size(); ++x)
            colors[x] = Color(sums[x] * scale + bias);
        writeFilteredRow(state, *images.dst, y, colors, space);
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
        std::vector<double> weights;  // row by row; the program's are column by column
        for (int j = kernelHeight - 1; j >= 0; --j)
            for (int i = kernelWidth - 1; i >= 0; --i)
                weights.push_back(double(kernel[i * kernelHeight + j]));
        const ColorSpace space = filterSpace(context.state);
        const glm::ivec2 first(offsetOf(shiftX), offsetOf(shiftY));
        if (areFilteredInTextures(
                context, images, space,
                SumFilter{{first, tilingMode, tileFillColor(context.state, space), scale, bias},
                          weights,
                          kernelWidth}))
            return;
        SourceLines source(
            *images.src, context.state, kernelHeight,
            placesOf(kernelWidth, first.x, images.width(), images.src->width(), tilingMode),
            placesOf(kernelHeight, first.y, images.height(), images.src->height(), tilingMode));
        writeSums(context.state, images, source, weights, kernelWidth, double(scale), double(bias));
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
        const std::vector<double> across = reversedWeights(kernelX, kernelWidth),
                                  up = reversedWeights(kernelY, kernelHeight);
        const ColorSpace space = filterSpace(context.state);
        const glm::ivec2 first(offsetOf(shiftX), offsetOf(shiftY));
        if (areFilteredInTextures(
                context, images, space,
                SeparableFilter{
                    {first, tilingMode, tileFillColor(context.state, space), scale, bias}, across, up}))
            return;
        SourceLines source(*images.src, context.state, kernelHeight,
                           placesOf(kernelWidth, first.x, images.width(), images.src->width(), tilingMode),
                           placesOf(kernelHeight, first.y, images.height(), images.src->height(), tilingMode),
                           across);
        writeSums(context.state, images, source, up, 1, double(scale), double(bias));
    });
}
