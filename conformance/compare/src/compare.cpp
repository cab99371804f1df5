#include "conformance/compare/compare.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace vtm::compare {
namespace {

constexpr double percentile = 0.999;

void requireEqualSizes(const image::Raster& a, const image::Raster& b) {
    if (a.width != b.width || a.height != b.height)
        throw std::invalid_argument("compare: " + std::to_string(a.width) + "x" + std::to_string(a.height) +
                                    " against " + std::to_string(b.width) + "x" + std::to_string(b.height));
}

/// |a - b| in 1/255. Not a number on either side is as wrong as can be, never equal.
double channelDifference(float a, float b) {
    const double difference = std::abs(double(a) - double(b)) * 255;
    return std::isnan(difference) ? std::numeric_limits<double>::infinity() : difference;
}

std::vector<double> channelDifferences(const image::Raster& a, const image::Raster& b) {
    std::vector<double> differences(a.rgba.size());
    for (std::size_t i = 0; i < differences.size(); ++i)
        differences[i] = channelDifference(a.rgba[i], b.rgba[i]);
    return differences;
}

/// Nearest rank: the smallest value that at least the share `percentile` of all values do not exceed.
double percentileOf(std::vector<double> values) {
    const auto rank = static_cast<std::ptrdiff_t>(std::ceil(percentile * double(values.size()))) - 1;
    std::nth_element(values.begin(), values.begin() + rank, values.end());
    return values[std::size_t(rank)];
}

void addPixel(Difference& result, const double* channels, double threshold, int x, int y) {
    const double worst = *std::max_element(channels, channels + 4);
    if (worst > threshold)
        ++result.over;
    if (worst > result.max) {
        result.max = worst;
        result.worstX = x;
        result.worstY = y;
    }
}

}  // namespace

Difference compare(const image::Raster& a, const image::Raster& b, double threshold) {
    requireEqualSizes(a, b);
    Difference result;
    const std::vector<double> differences = channelDifferences(a, b);
    if (differences.empty())
        return result;
    double sum = 0, squares = 0;
    for (const double d : differences) {
        sum += d;
        squares += d * d;
    }
    for (std::size_t i = 0; i < differences.size(); i += 4)
        addPixel(result, &differences[i], threshold, int(i / 4) % a.width, int(i / 4) / a.width);
    result.mean = sum / double(differences.size());
    result.rms = std::sqrt(squares / double(differences.size()));
    result.p999 = percentileOf(differences);
    return result;
}

image::Bitmap differencePicture(const image::Raster& a, const image::Raster& b, double gain) {
    requireEqualSizes(a, b);
    image::Bitmap picture{a.width, a.height, std::vector<std::uint8_t>(a.rgba.size(), 255)};
    for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
        // An opaque picture has no channel for alpha: its difference lightens all three.
        const double alpha = channelDifference(a.rgba[i + 3], b.rgba[i + 3]);
        for (std::size_t c = 0; c < 3; ++c) {
            const double d = std::max(channelDifference(a.rgba[i + c], b.rgba[i + c]), alpha) * gain;
            picture.rgba[i + c] = static_cast<std::uint8_t>(std::lround(std::min(d, 255.0)));
        }
    }
    return picture;
}

}  // namespace vtm::compare
