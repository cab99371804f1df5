/// \file
/// Mip pyramids of mean colours: grids over the whole picture, each coarser than the one before, down to one
/// texel.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#pragma GCC visibility push(default)

namespace vtm::asset {

/// Max side of a pyramid, texels.
inline constexpr std::uint32_t maxPyramidSide = 4096;

/// Premultiplied sRGB-encoded red, green, blue, alpha.
using Rgba8 = std::array<std::uint8_t, 4>;

/// Level l has max(1, width >> l) by max(1, height >> l) texels, as OpenGL's mipmaps have, and covers the
/// picture [0, width] × [0, height] exactly. Sides are 2^k or 3·2^k, so each texel covers whole texels of the
/// finer level (1, 2 or, once, 3 along each axis) and its mean is the mean of theirs.
struct PyramidSize {
    std::uint32_t width = 0, height = 0;

    bool empty() const { return width == 0; }
    unsigned levels() const { return unsigned(std::bit_width(std::max(width, height))); }
    PyramidSize level(unsigned l) const { return {std::max(1u, width >> l), std::max(1u, height >> l)}; }
    std::size_t texels() const { return std::size_t(width) * height; }
    /// Number of texels in the levels before l; l = levels() gives all of them.
    std::size_t texelsBefore(unsigned l) const {
        std::size_t sum = 0;
        for (unsigned i = 0; i < l; ++i)
            sum += level(i).texels();
        return sum;
    }
    bool operator==(const PyramidSize&) const = default;
};

/// Returns whether a pyramid may have this side: 2^k or 3·2^k, at most maxPyramidSide.
constexpr bool isPyramidSide(std::uint32_t side) {
    return side > 0 && side <= maxPyramidSide &&
           (std::has_single_bit(side) || (side % 3 == 0 && std::has_single_bit(side / 3)));
}

/// The picture's mean colour over each texel: levels from fine to coarse, rows from the top.
struct Prefilter {
    PyramidSize size;
    std::vector<Rgba8> texels;
};
struct PrefilterView {
    PyramidSize size;
    std::span<const Rgba8> texels;
};

}  // namespace vtm::asset

#pragma GCC visibility pop
