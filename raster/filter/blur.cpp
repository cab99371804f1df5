// The Gaussian blur, at a cost that does not depend on its deviation.
//
// A deviation of s to 2s pixels, s a power of two not below 2, is blurred on a raster that is s times coarser
// along that axis: means of s pixels, a sampled Gaussian, and cubic B-splines back to the pixels. Means add
// (s² - 1)/12 to the variance and splines s²/3, so the Gaussian between has that much less:
//   deviation'² = (deviation² - (s² - 1)/12 - s²/3) / s² >= 4 - 5/12 coarse pixels².
// What such a Gaussian leaves of frequencies that coarse pixels cannot hold is below e^-17. The kernel is cut
// off at 3.5 deviations (0.05 %) and normalised. The tests compare with the Gaussian itself: within 1/512.

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include <vtm/limits/limits.hpp>
#include "raster/filter/operations.hpp"
#include "raster/filter_tables.hpp"

namespace vtm::asset {

namespace {

/// A deviation below moves no 8-bit colour: exp(-1 / (2 · 0.25²)) = 1/2981.
constexpr double leastDeviation = 0.25;
constexpr double kernelReach = 3.5;  ///< deviations
/// Larger ones, in pixels, spread every picture that there may be over more than it is large.
constexpr double largestDeviation = 0x1p20;
int floorDivide(int a, int b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

}  // namespace

AxisBlur axisBlur(double deviation) {
    AxisBlur axis;
    if (!(deviation >= leastDeviation))
        return axis;
    deviation = std::min(deviation, largestDeviation);
    while (deviation >= 4 * axis.step)
        axis.step *= 2;
    const double s = axis.step;
    const double added = axis.step == 1 ? 0 : (s * s - 1) / 12 + s * s / 3;
    const double coarse = std::sqrt(deviation * deviation - added) / s;
    const int reach = int(std::ceil(kernelReach * coarse));
    std::vector<double> weights;
    double sum = 0;
    for (int i = 0; i <= reach; ++i) {
        weights.push_back(std::exp(-0.5 * i * i / (coarse * coarse)));
        sum += i == 0 ? weights.back() : 2 * weights.back();
    }
    for (const double weight : weights)
        axis.kernel.push_back(float(weight / sum));
    return axis;
}

int blurReach(double deviation) {
    const AxisBlur axis = axisBlur(deviation);
    if (axis.kernel.empty())
        return 0;
    return axis.step * (int(axis.kernel.size()) + (axis.step > 1 ? splineReach : 0));
}

PixelBox coarsened(const PixelBox& box, glm::ivec2 steps) {
    return {{floorDivide(box.min.x, steps.x), floorDivide(box.min.y, steps.y)},
            {floorDivide(box.max.x - 1, steps.x) + 1, floorDivide(box.max.y - 1, steps.y) + 1}};
}

namespace {

/// Means over coarse pixels of steps.x by steps.y.
Layer reduced(const Layer& layer, glm::ivec2 steps) {
    Layer result(coarsened(layer.box, steps), layer.linear);
    const float share = 1 / (float(steps.x) * float(steps.y));
    for (int y = layer.box.min.y; y < layer.box.max.y; ++y) {
        limits::check();
        const Float4* from = layer.row(y);
        Float4* to = result.row(floorDivide(y, steps.y));
        for (int x = layer.box.min.x, coarse = 0; x < layer.box.max.x; ++coarse) {
            const int end = std::min(layer.box.max.x, (result.box.min.x + coarse + 1) * steps.x);
            Float4 sum{};
            for (; x < end; ++x)
                sum += *from++;
            to[coarse] += share * sum;
        }
    }
    return result;
}

/// So many pixels are computed at once, in registers.
constexpr int atOnce = 4;

/// A weight in each channel, from the left end to the right, between atOnce - 1 zeros.
std::vector<Float4> spread(const std::vector<float>& kernel) {
    const std::size_t reach = kernel.size() - 1, margin = atOnce - 1;
    std::vector<Float4> weights(2 * (reach + margin) + 1);
    for (std::size_t i = 0; i <= reach; ++i) {
        const Float4 weight{kernel[i], kernel[i], kernel[i], kernel[i]};
        weights[margin + reach + i] = weights[margin + reach - i] = weight;
    }
    return weights;
}

/// to[i] = Σ kernel[|k|] · from[i + k + reach], for atOnce pixels more than `count` at most; `from` has as
/// many more.
void convolveRow(const Float4* from, const std::vector<Float4>& weights, Float4* to, int count) {
    const int taps = int(weights.size()) - (atOnce - 1);
    for (int i = 0; i < count; i += atOnce, from += atOnce, to += atOnce) {
        Float4 a{}, b{}, c{}, d{};
        const Float4* weight = weights.data() + (atOnce - 1);
        for (int k = 0; k < taps; ++k, ++weight) {
            const Float4 color = from[k];
            a += weight[0] * color;
            b += weight[-1] * color;
            c += weight[-2] * color;
            d += weight[-3] * color;
        }
        to[0] = a, to[1] = b, to[2] = c, to[3] = d;
    }
}

Layer alongRows(const Layer& layer, const std::vector<float>& kernel, int left, int right) {
    const PixelBox box{{left, layer.box.min.y}, {right, layer.box.max.y}};
    if (kernel.empty())
        return cropped(layer, box);
    Layer result = Layer::unwritten(box, layer.linear);
    if (result.empty())
        return result;
    // A row of the layer with what the result's pixels read beside it, transparent.
    const int reach = int(kernel.size()) - 1, first = left - reach;
    const std::vector<Float4> weights = spread(kernel);
    const int from = std::max(first, layer.box.min.x), to = std::min(right + reach, layer.box.max.x);
    byRows(box, [&](const PixelBox& part) {
        std::vector<Float4> row(std::size_t(right - left + 2 * (reach + atOnce))),
            blurred(std::size_t(right - left + atOnce));
        for (int y = part.min.y; y < part.max.y; ++y) {
            limits::check();
            if (from < to)
                std::copy_n(layer.row(y) + (from - layer.box.min.x), to - from, row.begin() + (from - first));
            convolveRow(row.data(), weights, blurred.data(), right - left);
            std::copy_n(blurred.begin(), right - left, result.row(y));
        }
    });
    return result;
}

/// to[x] = Σ weights · rows, over so many rows of `width` pixels.
void convolveColumns(const Float4* from, std::ptrdiff_t rowPixels, std::span<const float> weights, Float4* to,
                     int width) {
    int x = 0;
    for (; x + atOnce <= width; x += atOnce) {
        Float4 a{}, b{}, c{}, d{};
        const Float4* color = from + x;
        for (const float weight : weights) {
            a += weight * color[0];
            b += weight * color[1];
            c += weight * color[2];
            d += weight * color[3];
            color += rowPixels;
        }
        to[x] = a, to[x + 1] = b, to[x + 2] = c, to[x + 3] = d;
    }
    for (; x < width; ++x) {
        const Float4* color = from + x;
        Float4 sum{};
        for (const float weight : weights) {
            sum += weight * *color;
            color += rowPixels;
        }
        to[x] = sum;
    }
}

Layer alongColumns(const Layer& layer, const std::vector<float>& kernel, int top, int bottom) {
    const PixelBox box{{layer.box.min.x, top}, {layer.box.max.x, bottom}};
    if (kernel.empty())
        return cropped(layer, box);
    Layer result = Layer::unwritten(box, layer.linear);
    const int reach = int(kernel.size()) - 1, width = result.width();
    std::vector<float> weights(2 * kernel.size() - 1);
    for (int k = -reach; k <= reach; ++k)
        weights[std::size_t(k + reach)] = kernel[std::size_t(std::abs(k))];
    eachRow(box, [&](int y) {
        limits::check();
        const int low = std::max(y - reach, layer.box.min.y), end = std::min(y + reach + 1, layer.box.max.y);
        if (low < end)
            convolveColumns(layer.row(low), width,
                            std::span(weights).subspan(std::size_t(low - y + reach), std::size_t(end - low)),
                            result.row(y), width);
        else
            std::fill_n(result.row(y), width, Float4{});
    });
    return result;
}

/// Weights of the coarse pixels round a pixel's centre: the cubic B-spline.
struct Spline {
    int first;  ///< coarse pixel
    std::array<float, 4> weights;
};

Spline splineAt(int pixel, int step) {
    const float at = (float(pixel) + 0.5f) / float(step) - 0.5f;
    const float whole = std::floor(at), t = at - whole, u = 1 - t;
    return {int(whole) - 1,
            {u * u * u / 6, (4 - 6 * t * t + 3 * t * t * t) / 6, (4 - 6 * u * u + 3 * u * u * u) / 6,
             t * t * t / 6}};
}

/// Back to pixels [left, right) along rows. The coarse ones reach splineReach further.
Layer enlargedRows(const Layer& coarse, int step, int left, int right) {
    Layer result = Layer::unwritten({{left, coarse.box.min.y}, {right, coarse.box.max.y}}, coarse.linear);
    std::vector<Spline> splines;
    for (int x = left; x < right; ++x)
        splines.push_back(splineAt(x, step));
    eachRow(result.box, [&](int y) {
        limits::check();
        Float4* to = result.row(y);
        for (const Spline& spline : splines) {
            const Float4* from = coarse.row(y) + (spline.first - coarse.box.min.x);
            const auto& w = spline.weights;
            *to++ = w[0] * from[0] + w[1] * from[1] + w[2] * from[2] + w[3] * from[3];
        }
    });
    return result;
}

/// The same along columns.
Layer enlargedColumns(const Layer& coarse, int step, int top, int bottom) {
    Layer result = Layer::unwritten({{coarse.box.min.x, top}, {coarse.box.max.x, bottom}}, coarse.linear);
    eachRow(result.box, [&](int y) {
        limits::check();
        const Spline spline = splineAt(y, step);
        convolveColumns(coarse.row(spline.first), coarse.width(), spline.weights, result.row(y),
                        result.width());
    });
    return result;
}

}  // namespace

Layer gaussianBlur(const FilterStep& step) {
    const glm::dvec2 deviation = glm::dvec2(step.parameters[0], step.parameters[1]) * step.scale;
    const Layer& input = *step.inputs[0];
    const PixelBox box =
        input.box.grown({blurReach(deviation.x), blurReach(deviation.y)}).intersection(step.box);
    if (input.empty() || box.empty())
        return Layer({}, step.linear);
    const AxisBlur x = axisBlur(deviation.x), y = axisBlur(deviation.y);
    const glm::ivec2 steps(x.step, y.step);
    const PixelBox needed =
        coarsened(box, steps).grown({x.step > 1 ? splineReach : 0, y.step > 1 ? splineReach : 0});
    const bool coarsens = x.step > 1 || y.step > 1;
    const Layer coarse = coarsens ? reduced(input, steps) : Layer();
    Layer blurred = alongColumns(alongRows(coarsens ? coarse : input, x.kernel, needed.min.x, needed.max.x),
                                 y.kernel, needed.min.y, needed.max.y);
    if (x.step > 1)
        blurred = enlargedRows(blurred, x.step, box.min.x, box.max.x);
    if (y.step > 1)
        blurred = enlargedColumns(blurred, y.step, box.min.y, box.max.y);
    return blurred;
}

}  // namespace vtm::asset
