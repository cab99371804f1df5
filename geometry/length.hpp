/// \file
/// Lengths of curves.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace vtm::geometry {

/// Gauss's rule of eight points for the integral of `speed` over [t0, t1].
template <class Speed>
double gaussLength(const Speed& speed, double t0, double t1) {
    // Positive abscissae and their weights on [-1, 1].
    constexpr std::array<std::array<double, 2>, 4> rule{{{0.1834346424956498, 0.3626837833783620},
                                                         {0.5255324099163290, 0.3137066458778873},
                                                         {0.7966664774136267, 0.2223810344533745},
                                                         {0.9602898564975363, 0.1012285362903763}}};
    const double middle = (t0 + t1) / 2, half = (t1 - t0) / 2;
    double sum = 0;
    for (const auto& [x, weight] : rule)
        sum += weight * (speed(middle - half * x) + speed(middle + half * x));
    return sum * half;
}

/// Halvings at most: a cusp halves the step once a level, and 2^-24 of a curve is negligible.
inline constexpr int maxLengthHalvings = 24;

/// By comparison of the rule over [t0, t1], which gave `whole`, with the rule over its halves.
template <class Speed>
double refinedLength(const Speed& speed, double t0, double t1, double whole, double tolerance, int halvings) {
    const double middle = (t0 + t1) / 2;
    const double left = gaussLength(speed, t0, middle), right = gaussLength(speed, middle, t1);
    constexpr double rounding = 1e-15;  // of a sum of sixteen
    if (halvings == 0 || std::abs(left + right - whole) <= std::max(tolerance, rounding * whole))
        return left + right;
    return refinedLength(speed, t0, middle, left, tolerance / 2, halvings - 1) +
           refinedLength(speed, middle, t1, right, tolerance / 2, halvings - 1);
}

/// The length over [t0, t1] of a curve that runs at speed(t), within `tolerance` or the rounding of the sums.
template <class Speed>
double arcLength(const Speed& speed, double t0, double t1, double tolerance) {
    return refinedLength(speed, t0, t1, gaussLength(speed, t0, t1), tolerance, maxLengthHalvings);
}

/// The same within a share of the length.
template <class Speed>
double relativeArcLength(const Speed& speed, double t0, double t1, double share) {
    const double whole = gaussLength(speed, t0, t1);
    return refinedLength(speed, t0, t1, whole, share * whole, maxLengthHalvings);
}

}  // namespace vtm::geometry
