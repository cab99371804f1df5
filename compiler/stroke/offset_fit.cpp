#include "compiler/stroke/offset_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace vtm::compiler::stroke {

namespace {

constexpr int maxPieces = 8;

/// How many pieces bring the error of a fit below the tolerance, by its sixth order.
int pieceCount(double error, double tolerance) {
    if (!std::isfinite(error))
        return 2;
    return int(std::clamp(std::ceil(std::pow(error / tolerance, 1.0 / 6)), 2.0, double(maxPieces)));
}

/// Ends of the pieces as shares of the stretch, the first 0. Pieces take equal sums of the square roots of
/// the turns between samples: shorter ones where the curve bends, longer ones where it hardly does. A tenth
/// goes by the parameter alone, so that no piece is without end.
std::array<double, maxPieces + 1> cuts(const Samples& s, int count) {
    constexpr double evenShare = 0.1;
    constexpr std::size_t steps = std::tuple_size_v<Samples> - 1;
    std::array<double, steps + 1> sums{};
    for (std::size_t i = 0; i < steps; ++i)
        sums[i + 1] = sums[i] + std::sqrt(std::abs(cross(s[i].tangent, s[i + 1].tangent)));
    const double even = sums[steps] > 0 ? sums[steps] * evenShare / steps : 1;
    for (std::size_t i = 0; i <= steps; ++i)
        sums[i] += even * double(i);
    std::array<double, maxPieces + 1> result{};
    std::size_t at = 0;
    for (int k = 1; k < count; ++k) {
        const double goal = sums[steps] * k / count;
        while (sums[at + 1] < goal)
            ++at;
        result[std::size_t(k)] = (double(at) + (goal - sums[at]) / (sums[at + 1] - sums[at])) / steps;
    }
    result[std::size_t(count)] = 1;
    return result;
}

void appendFit(const OffsetCurve& curve, double u0, double u1, double tolerance, int depth, Side& side) {
    const Samples samples = curve.samples(u0, u1);
    if (depth == 0 || isChord(samples, tolerance))
        return side.lineTo(samples.back().at, gapShare * tolerance);
    const Fit fit = fitCubic(samples, tolerance);
    if (fit.error <= tolerance)
        return side.cubicTo(fit.cubic.p1, fit.cubic.p2, fit.cubic.p3);
    const int count = pieceCount(fit.error, tolerance);
    const auto shares = cuts(samples, count);
    for (std::size_t i = 0; i < std::size_t(count); ++i)
        appendFit(curve, u0 + (u1 - u0) * shares[i], u0 + (u1 - u0) * shares[i + 1], tolerance, depth - 1,
                  side);
}

}  // namespace

void appendFit(const OffsetCurve& curve, double tolerance, Side& side) {
    side.lineTo(curve.stretch.offset(0, curve.distance).at, gapShare * tolerance);
    appendFit(curve, 0, 1, tolerance, maxFitDepth, side);
}

}  // namespace vtm::compiler::stroke
