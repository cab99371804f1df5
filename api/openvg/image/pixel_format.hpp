/// \file
/// Pixels as words: VGImageFormat and the formats of drawing surfaces (specification sections 3.4.4
/// and 10.2).
#pragma once

#include <cstdint>
#include <optional>

#include <VG/openvg.h>

#include "api/openvg/paint/color.hpp"

namespace vtm::openvg {

/// Bits of a word that hold a number from 0 to 2^bits - 1; none if bits is 0.
struct Channel {
    std::uint8_t bits = 0, shift = 0;

    friend bool operator==(const Channel&, const Channel&) = default;
};

/// A word of 32 bits or less. Either red, green and blue have bits, or grey has, or only alpha, which then is
/// that of a white linear colour.
struct PixelFormat {
    unsigned bits = 0;  ///< of a pixel in memory: 1, 4, 8, 16 or 32
    Channel red, green, blue, alpha, grey;
    ColorSpace space;

    /// In `space`; alpha is 1 where there is none. Premultiplied colours are clamped to [0, alpha].
    Color decode(std::uint32_t word) const;
    /// Rounds to nearest; takes a colour in `space`, clamps it to [0, 1] and, premultiplied, to [0, alpha].
    /// Bits that no channel has are 0.
    std::uint32_t encode(Color color) const;

    friend bool operator==(const PixelFormat&, const PixelFormat&) = default;
};

/// Nothing unless the value is one of VGImageFormat.
std::optional<PixelFormat> imageFormat(VGint format);

}  // namespace vtm::openvg
