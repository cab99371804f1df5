// Section 12.4: Gaussian blurs, in a time that does not depend on the deviation.
//
// Along each dimension a wide Gaussian is computed on every step-th pixel: cubics gather the pixels there,
// and interpolate between what comes out. With h the cubic interpolation of Catmull and Rom
// (h(t) = 1.5 |t|³ - 2.5 |t|² + 1 for |t| < 1, -0.5 |t|³ + 2.5 |t|² - 4 |t| + 2 for |t| < 2), gathered values
// are g(k) = Σ h(x / step - k) f(x) / step, and results Σ h(x / step - k) (G * g)(k). h reproduces
// quadratics, so neither changes the variance, and G is the Gaussian of deviation / step.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "api/openvg/image/filter_images.hpp"
#include "api/openvg/paint/lanes.hpp"

using namespace vtm::openvg;

namespace {

/// In steps, at least: two dimensions together stay within 0.8 / 255 of the sum for any pixels in [0, 1]
/// (0.36 / 255 each at 2.5; 0.19 / 255 at 3). Smaller deviations take steps of one pixel, which are exact.
constexpr double minDeviation = 2.5;
/// In deviations: beyond lies 0.0005 of the Gaussian.
constexpr double maxReach = 3.5;

float cubic(double t) {
    t = std::abs(t);
    return float(t < 1 ? (1.5 * t - 2.5) * t * t + 1 : t < 2 ? ((-0.5 * t + 2.5) * t - 4) * t + 2 : 0);
}

/// From the middle to one side.
std::vector<float> gaussian(double deviation) {
    const int reach = int(std::ceil(maxReach * deviation));
    std::vector<double> values;
    for (int i = 0; i <= reach; ++i)
        values.push_back(std::exp(-0.5 * (i / deviation) * (i / deviation)));
    const double sum = 2 * std::accumulate(values.begin(), values.end(), 0.0) - 1;
    std::vector<float> weights;
    for (const double v : values)
        weights.push_back(float(v / sum));
    return weights;
}

/// From one side to the other.
std::vector<double> wholeGaussian(double deviation) {
    const std::vector<float> half = gaussian(deviation);
    std::vector<double> weights(half.rbegin(), half.rend());
    weights.insert(weights.end(), half.begin() + 1, half.end());
    return weights;
}

/// A blur of a line. Samples are its steps from -1 on; where a step is a pixel, from 0 on.
class LineBlur {
public:
    /// `count`: results, of a line of `size` pixels.
    LineBlur(double deviation, int count, int size, VGTilingMode mode)
        : step_(std::max(1, int(deviation / minDeviation))),
          weights_(gaussian(deviation / step_)),
          samples_(step_ == 1 ? count : (count - 1) / step_ + 4) {
        const int reach = taps() / 2, gatheringReach = step_ > 1 ? 2 * step_ - 1 : 0;
        for (int i = 0; i <= gatheringReach; ++i)
            gathering_.push_back(cubic(double(i) / step_) / float(step_));
        for (int t = 0; t < step_; ++t)
            for (int k = -1; k <= 2; ++k)
                between_.push_back(cubic(double(t) / step_ - k));
        const int first = step_ == 1 ? -reach : (-1 - reach) * step_ - gatheringReach,
                  end = first + (gathered() - 1) * step_ + 2 * gatheringReach + 1;
        places_ = tiledPlaces(first, end, size, mode);
    }

    int step() const { return step_; }
    int samples() const { return samples_; }
    /// What the samples are weighted sums of, `taps` each; weights from the middle to one side.
    int gathered() const { return samples_ + taps() - 1; }
    int taps() const { return 2 * int(weights_.size()) - 1; }
    std::span<const float> weights() const { return weights_; }
    /// The same of what is gathered, `step` pixels apart, from those of places().
    std::span<const float> gathering() const { return gathering_; }
    const std::vector<int>& places() const { return places_; }
    /// Of four samples from x / step on.
    std::span<const float> between(int x) const {
        return std::span(between_).subspan(std::size_t(4 * (x % step_)), 4);
    }

private:
    int step_;
    std::vector<float> weights_;
    int samples_;
    std::vector<float> gathering_, between_;
    std::vector<int> places_;
};

using Rows = std::vector<const Color*>;

/// sums[i] = Σ weights[|k|] * taps[middle + k][i].
struct SymmetricSums {
    std::span<const Color* const> taps;
    std::span<const float> weights;
    Color* sums;
};

/// As many vectors of colours as registers hold, each tap of all of them after the other, with whatever
/// instructions the caller is compiled for.
template <class Vector, std::size_t count>
__attribute__((always_inline)) inline void symmetricSome(const SymmetricSums& s, std::size_t first) {
    constexpr std::size_t colors = sizeof(Vector) / sizeof(Color);
    const std::size_t middle = s.weights.size() - 1;
    Vector total[count], before, after;
    for (std::size_t j = 0; j < count; ++j) {
        std::memcpy(&before, &s.taps[middle][first + j * colors], sizeof before);
        total[j] = before * s.weights[0];
    }
    for (std::size_t k = 1; k <= middle; ++k) {
        const Color *const a = s.taps[middle - k] + first, *const b = s.taps[middle + k] + first;
        for (std::size_t j = 0; j < count; ++j) {
            std::memcpy(&before, a + j * colors, sizeof before);
            std::memcpy(&after, b + j * colors, sizeof after);
            total[j] += (before + after) * s.weights[k];
        }
    }
    std::memcpy(&s.sums[first], total, sizeof total);
}

template <class Vector>
__attribute__((always_inline)) inline void symmetricAll(const SymmetricSums& s, std::size_t first,
                                                        std::size_t end) {
    constexpr std::size_t count = 8, atOnce = count * sizeof(Vector) / sizeof(Color);
    for (; first + atOnce <= end; first += atOnce)
        symmetricSome<Vector, count>(s, first);
    for (; first < end; ++first)
        symmetricSome<Float4, 1>(s, first);
}

#ifdef __x86_64__
__attribute__((target("avx2"))) void symmetricWide(const SymmetricSums& s, std::size_t first,
                                                   std::size_t end) {
    using Float8 = float __attribute__((vector_size(32)));
    symmetricAll<Float8>(s, first, end);
}
#endif

/// From `first` to `end` - 1. Results are the same on all processors.
void symmetricSums(const SymmetricSums& s, std::size_t first, std::size_t end) {
#ifdef __x86_64__
    static const bool isWide = __builtin_cpu_supports("avx2");
    if (isWide)
        return symmetricWide(s, first, end);
#endif
    symmetricAll<Float4>(s, first, end);
}

/// Between the second and the third of four.
Color between(const Color* a, std::ptrdiff_t next, std::span<const float> weights) {
    Color result;
    assign(result, loaded(a[0]) * splat(weights[0]) + loaded(a[next]) * splat(weights[1]) +
                       loaded(a[2 * next]) * splat(weights[2]) + loaded(a[3 * next]) * splat(weights[3]));
    return result;
}

/// From row to row, in colours: an odd number of lines of a cache, where rows below each other would share a
/// few places.
std::size_t strideOf(std::size_t width) { return 4 * ((width + 3) / 4 | 1); }

/// The samples of every row of the source, and of a row of the fill colour.
class SampledRows {
public:
    SampledRows(const LineBlur& blur, const Image& source, ColorSpace space, Color fill)
        : width_(std::size_t(blur.samples())),
          stride_(strideOf(width_)),
          samples_(stride_ * std::size_t(source.height())),
          fill_(width_, fill) {
        std::vector<Color> colors(std::size_t(source.width())), line(blur.places().size()),
            gathered(blur.step() > 1 ? std::size_t(blur.gathered()) : 0);
        const Color* const from = blur.step() > 1 ? gathered.data() : line.data();
        Rows taps;
        for (std::size_t k = 0; k < std::size_t(blur.taps()); ++k)
            taps.push_back(from + k);
        for (int y = 0; y < source.height(); ++y) {
            normalizedRow(source, y, space, colors);
            for (std::size_t i = 0; i < line.size(); ++i)
                line[i] = blur.places()[i] < 0 ? fill : colors[std::size_t(blur.places()[i])];
            gather(blur, line, gathered);
            symmetricSums({taps, blur.weights(), samples_.data() + stride_ * std::size_t(y)}, 0, width_);
        }
    }

    std::size_t width() const { return width_; }
    /// -1: of the fill colour.
    const Color* row(int y) const {
        return y < 0 ? fill_.data() : samples_.data() + stride_ * std::size_t(y);
    }

private:
    static void gather(const LineBlur& blur, std::span<const Color> line, std::span<Color> gathered) {
        const std::span<const float> weights = blur.gathering();
        const std::size_t middle = weights.size() - 1;
        const Color* from = line.data() + middle;
        for (Color& color : gathered) {
            Float4 sum = loaded(*from) * splat(weights[0]);
            for (std::size_t i = 1; i <= middle; ++i)
                sum += (loaded(*(from - i)) + loaded(from[i])) * splat(weights[i]);
            assign(color, sum);
            from += blur.step();
        }
    }

    std::size_t width_, stride_;
    std::vector<Color> samples_, fill_;
};

/// Rows of samples, blurred up and down.
class BlurredRows {
public:
    BlurredRows(const LineBlur& blur, const SampledRows& source)
        : blur_(blur), width_(source.width()), stride_(strideOf(width_)) {
        for (const int y : blur.places())
            places_.push_back(source.row(y));
        if (blur.step() > 1)
            gather();
        samples_.resize(stride_ * std::size_t(blur.step() > 1 ? blur.samples() : maxGroup));
        row_.resize(width_);
        if (blur.step() > 1)
            sample(0, blur.samples());
    }

    /// From the first on, one after the other.
    std::span<Color> row(int y) {
        if (blur_.step() == 1) {
            if (y % maxGroup == 0)
                sample(y, std::min(maxGroup, blur_.samples() - y));
            return std::span(samples_).subspan(stride_ * std::size_t(y % maxGroup), width_);
        }
        const Color* const samples = samples_.data() + stride_ * std::size_t(y / blur_.step());
        for (std::size_t i = 0; i < width_; ++i)
            row_[i] = between(samples + i, std::ptrdiff_t(stride_), blur_.between(y));
        return row_;
    }

private:
    /// Rows that are summed at once, as many columns at a time as leave their taps in the first cache.
    static constexpr int maxGroup = 8;
    static constexpr std::size_t strip = 32;

    /// Replaces places_ by what is gathered from them.
    void gather() {
        const auto step = std::size_t(blur_.step()), gathered = std::size_t(blur_.gathered()),
                   taps = 2 * blur_.gathering().size() - 1;
        gathered_.resize(stride_ * gathered);
        Rows rows;
        for (std::size_t k = 0; k < gathered; ++k) {
            Color* const row = gathered_.data() + stride_ * k;
            symmetricSums({std::span(places_).subspan(step * k, taps), blur_.gathering(), row}, 0, width_);
            rows.push_back(row);
        }
        places_ = std::move(rows);
    }

    /// Samples from k on, to the first rows of samples_.
    void sample(int k, int count) {
        for (std::size_t first = 0; first < width_; first += strip)
            for (int i = 0; i < count; ++i)
                symmetricSums({std::span(places_).subspan(std::size_t(k + i), std::size_t(blur_.taps())),
                               blur_.weights(), samples_.data() + stride_ * std::size_t(i)},
                              first, std::min(first + strip, width_));
    }

    const LineBlur& blur_;
    std::size_t width_, stride_;
    Rows places_;
    std::vector<Color> gathered_, samples_, row_;
};

}  // namespace

void vgGaussianBlur(VGImage dst, VGImage src, VGfloat stdDeviationX, VGfloat stdDeviationY,
                    VGTilingMode tilingMode) {
    call([&](Context& context) {
        const FilterImages images(context, dst, src);
        for (const VGfloat deviation : {stdDeviationX, stdDeviationY})
            require(deviation > 0 && deviation <= VGfloat(maxGaussianStdDeviation));
        require(isTiling(tilingMode));
        const ColorSpace space = filterSpace(context.state);
        SeparableFilter filter{{{}, tilingMode, tileFillColor(context.state, space)},
                               wholeGaussian(double(stdDeviationX)),
                               wholeGaussian(double(stdDeviationY))};
        filter.first = {-int(filter.across.size() / 2), -int(filter.up.size() / 2)};
        if (areFilteredInTextures(context, images, space, std::move(filter)))
            return;
        const LineBlur across(double(stdDeviationX), images.width(), images.src->width(), tilingMode),
            up(double(stdDeviationY), images.height(), images.src->height(), tilingMode);
        const SampledRows source(across, *images.src, space, tileFillColor(context.state, space));
        BlurredRows rows(up, source);
        std::vector<Color> colors(std::size_t(images.width()));
        for (int y = 0; y < images.height(); ++y) {
            const std::span<Color> samples = rows.row(y);
            if (across.step() > 1)
                for (int x = 0; x < images.width(); ++x)
                    colors[std::size_t(x)] =
                        between(samples.data() + x / across.step(), 1, across.between(x));
            writeFilteredRow(context.state, *images.dst, y, across.step() > 1 ? std::span(colors) : samples,
                             space);
        }
    });
}
