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

#include <vtm/limits/limits.hpp>
#include "raster/filter/operations.hpp"

namespace vtm::asset {

namespace {

/// A deviation below moves no 8-bit colour: exp(-1 / (2 · 0.25²)) = 1/2981.
constexpr double leastDeviation = 0.25;
constexpr double kernelReach = 3.5;  ///< deviations
/// Larger ones, in pixels, spread every picture that there may be over more than it is large.
constexpr double largestDeviation = 0x1p20;
/// Coarse pixels beside the last that splines read.
constexpr int splineReach = 2;

/// How one axis is blurred.
struct AxisBlur {
    int step = 1;               ///< pixels of a coarse one
    std::vector<float> kernel;  ///< from the centre outwards; empty: nothing is blurred
};

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

int floorDivide(int a, int b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

/// Coarse pixels that lie over those of a box.
PixelBox coarsened(const PixelBox& box, glm::ivec2 steps) {
    return {{floorDivide(box.min.x, steps.x), floorDivide(box.min.y, steps.y)},
            {floorDivide(box.max.x - 1, steps.x) + 1, floorDivide(box.max.y - 1, steps.y) + 1}};
}

/// Means over coarse pixels of steps.x by steps.y.
Layer reduced(const Layer& layer, glm::ivec2 steps) {
    if (steps.x == 1 && steps.y == 1)
        return layer;
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

/// to[i] = Σ kernel[|k|] · from[first + i + k], transparent beyond `length` pixels.
void convolveRow(const Float4* from, int length, int first, const std::vector<float>& kernel, Float4* to,
                 int count) {
    const int reach = int(kernel.size()) - 1;
    for (int i = 0; i < count; ++i) {
        const int centre = first + i;
        const int low = std::max(-reach, -centre), high = std::min(reach, length - 1 - centre);
        Float4 sum{};
        for (int k = low; k <= high; ++k)
            sum += kernel[std::size_t(std::abs(k))] * from[centre + k];
        to[i] = sum;
    }
}

Layer alongRows(const Layer& layer, const std::vector<float>& kernel, int left, int right) {
    if (kernel.empty())
        return cropped(layer, {{left, layer.box.min.y}, {right, layer.box.max.y}});
    Layer result({{left, layer.box.min.y}, {right, layer.box.max.y}}, layer.linear);
    for (int y = layer.box.min.y; y < layer.box.max.y && !result.empty(); ++y) {
        limits::check();
        convolveRow(layer.row(y), layer.width(), left - layer.box.min.x, kernel, result.row(y), right - left);
    }
    return result;
}

Layer alongColumns(const Layer& layer, const std::vector<float>& kernel, int top, int bottom) {
    if (kernel.empty())
        return cropped(layer, {{layer.box.min.x, top}, {layer.box.max.x, bottom}});
    Layer result({{layer.box.min.x, top}, {layer.box.max.x, bottom}}, layer.linear);
    const int reach = int(kernel.size()) - 1, width = result.width();
    for (int y = top; y < bottom && width > 0; ++y) {
        limits::check();
        Float4* to = result.row(y);
        const int low = std::max(y - reach, layer.box.min.y), high = std::min(y + reach, layer.box.max.y - 1);
        for (int other = low; other <= high; ++other) {
            const float weight = kernel[std::size_t(std::abs(other - y))];
            const Float4* from = layer.row(other);
            for (int x = 0; x < width; ++x)
                to[x] += weight * from[x];
        }
    }
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

/// Back to pixels, along one axis after the other.
Layer enlarged(const Layer& coarse, glm::ivec2 steps, const PixelBox& box) {
    Layer rows = coarse;
    if (steps.x > 1) {
        rows = Layer({{box.min.x, coarse.box.min.y}, {box.max.x, coarse.box.max.y}}, coarse.linear);
        for (int x = box.min.x; x < box.max.x; ++x) {
            const Spline spline = splineAt(x, steps.x);
            for (int y = coarse.box.min.y; y < coarse.box.max.y; ++y) {
                Float4 sum{};
                for (int k = 0; k < 4; ++k)
                    sum += spline.weights[std::size_t(k)] * coarse.at(spline.first + k, y);
                rows.row(y)[x - box.min.x] = sum;
            }
        }
    }
    if (steps.y == 1)
        return cropped(rows, box);
    Layer result(box, coarse.linear);
    for (int y = box.min.y; y < box.max.y; ++y) {
        limits::check();
        const Spline spline = splineAt(y, steps.y);
        Float4* to = result.row(y);
        for (int k = 0; k < 4; ++k) {
            const int other = spline.first + k;
            if (other < rows.box.min.y || other >= rows.box.max.y)
                continue;
            const Float4* from = rows.row(other) + (box.min.x - rows.box.min.x);
            const float weight = spline.weights[std::size_t(k)];
            for (int x = 0; x < result.width(); ++x)
                to[x] += weight * from[x];
        }
    }
    return result;
}

}  // namespace

int blurReach(double deviation) {
    const AxisBlur axis = axisBlur(deviation);
    if (axis.kernel.empty())
        return 0;
    return axis.step * (int(axis.kernel.size()) + (axis.step > 1 ? splineReach : 0));
}

Layer gaussianBlur(const FilterStep& step) {
    const AxisBlur x = axisBlur(step.parameters[0] * step.scale.x),
                   y = axisBlur(step.parameters[1] * step.scale.y);
    if (step.box.empty() || step.inputs[0]->empty())
        return Layer(step.box, step.linear);
    const glm::ivec2 steps(x.step, y.step);
    const Layer coarse = reduced(*step.inputs[0], steps);
    PixelBox needed = coarsened(step.box, steps);
    needed = needed.grown({x.step > 1 ? splineReach : 0, y.step > 1 ? splineReach : 0});
    const Layer rows = alongRows(coarse, x.kernel, needed.min.x, needed.max.x);
    return enlarged(alongColumns(rows, y.kernel, needed.min.y, needed.max.y), steps, step.box);
}

}  // namespace vtm::asset
