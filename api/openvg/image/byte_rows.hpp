/// \file
/// Rows of premultiplied pixels of four bytes, blended in 16 bits: results are within 1/255 of
/// s + d (1 - alpha), mostly its nearest byte.
#pragma once

#include <cstdint>

#include "api/openvg/paint/color.hpp"

namespace vtm::openvg {

/// A colour over pixels; bytes are in the order of its channels. `keepsAlpha`: the fourth byte stays.
void overBytes(std::uint8_t* pixels, int count, Color color, bool keepsAlpha);

/// Pixels over pixels, both with alpha in the same byte, the first or the last.
void overBytes(std::uint8_t* pixels, const std::uint8_t* sources, int count, int alphaByte);

/// Copies pixels; what is above its pixel's alpha is brought down to it. `from` and `to` may be the same.
void clampBytes(const std::uint8_t* from, std::uint8_t* to, int count, int alphaByte);

/// Copies pixels, colours multiplied by their pixel's alpha and rounded to nearest. `from` and `to` may be
/// the same.
void premultiplyBytes(const std::uint8_t* from, std::uint8_t* to, int count, int alphaByte);

/// Whether each pixel's alpha, the first or the last byte, is 255.
bool isOpaque(const std::uint8_t* pixels, int count, int alphaByte = 3);

namespace wide {

/// The same on processors with AVX2, of the first pixels: returns how many, none on others.
int overBytes(std::uint8_t* pixels, int count, const std::uint16_t (&added)[4],
              const std::uint16_t (&kept)[4]);
int overBytes(std::uint8_t* pixels, const std::uint8_t* sources, int count, int alphaByte);
int clampBytes(const std::uint8_t* from, std::uint8_t* to, int count, int alphaByte);
int premultiplyBytes(const std::uint8_t* from, std::uint8_t* to, int count, int alphaByte);

/// Moves each pixel's bytes: the i-th of the result is the given one, or 0 if that is negative, or'ed with
/// `added`.
int moveBytes(const std::uint8_t* from, std::uint8_t* to, int count, const int (&places)[4],
              std::uint32_t added);

/// A table of 256 bytes for the three colours of pixels of four bytes, in 16 parts: their exclusive or with
/// the part before, in either half by itself.
struct ByteTable {
    ByteTable(const std::uint8_t* values, int fromAlpha);

    std::uint8_t steps[16][16];
    int alphaByte;
};

/// Replaces the colours by the table, and moves bytes as above. `opaqueOnly`: stops at eight pixels that are
/// not all opaque.
int lookUpBytes(const std::uint8_t* from, std::uint8_t* to, int count, const ByteTable& table,
                const int (&places)[4], std::uint32_t added, bool opaqueOnly);

}  // namespace wide

}  // namespace vtm::openvg
