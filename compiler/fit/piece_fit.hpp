/// \file
/// One Hermite piece for some points of a chain.
#pragma once

#include <array>
#include <cstdint>

#include "compiler/lower/pairs.hpp"

namespace vtm::compiler {

/// Slopes beyond tan 22.5° are not fitted: longer turns take more pieces, which keeps four chords a
/// piece enough for the renderers (docs/coverage.md).
inline constexpr double maxSlope = 0.4142135623730951;

/// Points along a chord, from 0 to 1, and across it; one or two more fill the last pair.
struct LocalPoints {
    static constexpr std::uint32_t maxChords = 48;

    std::array<double, maxChords + 3> along, across;
};

/// Fits slopes over a chord; holds its workspace.
class PieceFit {
public:
    /// In units of 1 / asset::slopeScale.
    struct Slopes {
        std::int16_t a = 0, b = 0;
    };

    /// Slopes over the chord from a to b for points 0 .. last of a chain, 2 <= last <=
    /// LocalPoints::maxChords, of which the first and the last are about a and b. Returns by what factor the
    /// chain is too long, roughly; at most 1 if it stays within `tolerance` of the piece. That the chain's
    /// own ends are not quite a and b is not counted. Reads a point more.
    double run(const double* x, const double* y, std::uint32_t last, Pair a, Pair b, double tolerance);
    Slopes slopes() const { return slopes_; }

private:
    Slopes slopes_;
    LocalPoints local_;
};

}  // namespace vtm::compiler
