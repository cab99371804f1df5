/// \file
/// The few colours that stand for all of a picture's.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <vtm/image/bitmap.hpp>

namespace vtm::trace {

using Rgb = std::array<std::uint8_t, 3>;

/// Alpha from which on a pixel counts as there.
inline constexpr std::uint8_t minAlpha = 128;

struct Palette {
    std::vector<Rgb> colors;  ///< from light to dark
    /// Each pixel's colour, or -1 where it does not count as there.
    std::vector<int> indices;
};

/// At most `count` (> 0) colours: median cut, then k-means, both in OKLab. Deterministic. Equal to the
/// picture's own colours where these are no more than `count`. Source: Heckbert 1982 (median cut), Lloyd
/// 1982, Ottosson 2020 (OKLab).
Palette quantise(const image::Bitmap& bitmap, int count);

}  // namespace vtm::trace
