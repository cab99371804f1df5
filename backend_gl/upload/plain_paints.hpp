/// \file
/// Paint programs in a form that shaders draw quickly where they change little over a pixel
/// (shaders/tiles/plain_paint.glsl): layers over each other, each a gradient whose ramp is a table.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <vtm/asset/asset.hpp>
#include "raster/steepness.hpp"

namespace vtm::gl {

/// A paint as tiles have it. A solid one: premultiplied red | green << 16, blue | alpha << 16, 16-bit unorm.
/// A plain program: its first layer's texel, from the beginning of PlainPaints::texels, | number of layers <<
/// plainTexelBits; plainTag, which is no colour's. Others: 0.
using PaintWords = std::array<std::uint32_t, 2>;
inline constexpr unsigned plainTexelBits = 24;
inline constexpr std::uint32_t plainTag = 0xFFFF;

/// Of the word of a layer: its table's first texel in plainTexelBits; log2 of the table's segments; whether
/// the ramp is reflected, else padded; whether the layer is radial.
inline constexpr unsigned segmentBits = 4;
inline constexpr std::uint32_t reflectedBit = 1u << 28, radialBit = 1u << 29;
/// Premultiplied: what a table may be off by. Of as many segments as this a table can have.
inline constexpr double maxTableError = 0.2 / 255;
inline constexpr unsigned maxSegmentsLog2 = 12;

/// A program is plain if it has gradients, and beside them colours alone, over each other, and tables are
/// near enough to their ramps. A hard stop is not. Colours are mixed into the tables of gradients beside
/// them, and what lies below an opaque layer is left out.
///
/// - Layer, from the lowest on: three floats a, b, c and a word. t = a x + b y + c at a picture point.
/// Radial:
///   a second texel with floats a', b', c', e, and t = length(t, a' x + b' y + c') + e t.
/// - Table: a texel for each of 2^n equal parts of [0, 1] with the colours at its ends, PaintWords both.
struct PlainPaints {
    std::vector<asset::Texel> texels;  ///< layers and tables
    std::vector<PaintWords> words;     ///< by paint
};
PlainPaints plainPaints(const asset::AssetView& asset);

inline bool isPlainProgram(const PaintWords& words) { return words[1] == plainTag; }

/// Whether a paint has the same layers in both, wherever they stand.
bool isSame(const PlainPaints& a, const PlainPaints& b, std::size_t paint);

/// By how much slopes of a plain program's layers differ near some pixels, at most: premultiplied channels by
/// picture unit, all layers added. 0 where its ramps are straight.
double bendNear(std::span<const asset::Texel> texels, const PaintWords& program,
                const asset::PixelsNear& pixels);

}  // namespace vtm::gl
