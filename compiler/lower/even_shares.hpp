/// \file
/// Where to cut a curve so that all parts have an equal share.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "compiler/lower/pairs.hpp"

namespace vtm::compiler {

/// Samples a density over an interval of a parameter and cuts that into parts of equal integrals.
class EvenShares {
public:
    /// The integral of the density, which is given two parameters at once and counts parts, over [from, to].
    template <class Density>
    double integrate(double from, double to, const Density& density) {
        constexpr int few = 8;
        constexpr double tame = 0.0625;  // parts by which half as many steps may have changed the sum
        from_ = from;
        sample(few, (to - from) / few, density);
        double fewer = density_[0] + density_[few];
        for (std::size_t i = 2; i < few; i += 2)
            fewer += 2 * density_[i];
        if (!(std::abs(sums_[few] - fewer) * step_ <= tame))
            sample(maximum, (to - from) / maximum, density);
        return sums_[std::size_t(steps_)] * step_;
    }

    /// Where the first `count` - 1 of `count` equal parts end; the first and the last may be other shares of
    /// one. The density is taken to be linear in each step.
    void cut(int count, double* ends, double endShare = 1) const {
        const double share = sums_[std::size_t(steps_)] / (count - 2 + 2 * endShare);
        double goal = share * endShare;
        int k = 1;
        for (std::size_t in = 0; in < std::size_t(steps_); ++in) {
            const double start = double(in), sum = sums_[in], low = density_[in], square = low * low,
                         rise = 2 * (density_[in + 1] - low);
            const bool isLast = in + 1 == std::size_t(steps_);
            const double until = isLast ? std::numeric_limits<double>::infinity() : sums_[in + 1];
            for (; k < count && goal <= until; goal = share * (endShare + k++)) {
                const double area = goal - sum, root = std::sqrt(std::max(0.0, square + rise * area));
                *ends++ = from_ + (start + std::min(1.0, 2 * area / (low + root))) * step_;
            }
        }
    }

private:
    static constexpr int maximum = 16;

    template <class Density>
    void sample(int steps, double step, const Density& density) {
        steps_ = steps;
        step_ = step;
        Pair t = {from_, from_ + step};
        for (std::size_t i = 0; i <= std::size_t(steps); i += 2) {
            store(&density_[i], density(t));
            t += 2 * step;
        }
        double sum = 0;
        sums_[0] = 0;
        for (std::size_t i = 0; i < std::size_t(steps); ++i)
            sums_[i + 1] = sum += (density_[i] + density_[i + 1]) * 0.5;
    }

    double from_ = 0, step_ = 0;
    int steps_ = 0;
    /// At the ends of steps, and one more for loops over two at once; sums in steps.
    std::array<double, maximum + 2> density_, sums_;
};

}  // namespace vtm::compiler
