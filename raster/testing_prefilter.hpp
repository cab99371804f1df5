/// \file
/// Prefilters sampled on the CPU, for tests: of the pyramids themselves, and of the shader that samples them.
#pragma once

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <vtm/raster/prefilter.hpp>

namespace vtm::asset {

enum class Minification {
    Trilinear,  ///< one tap where a texel is as large as the footprint
    Taps2,      ///< 2 × 2 taps, texels half as large
    Taps4       ///< 4 × 4 taps, texels a quarter as large
};

/// How much of a footprint's colour the prefilter should give, in [0, 1]: rising from fadeFrom to fadeTo.
/// The rest is drawn from the tree.
float prefilterShare(const AssetView& asset, const glm::mat2& footprint);

/// The most sub-footprints side by side along the longer axis of a footprint.
inline constexpr int maxAnisotropy = 16;

/// Mean colour, premultiplied, over the parallelogram round `st` with the sides footprint[0] and
/// footprint[1]: where a pixel lies in the picture, both in shares of its width and height.
/// An asset without prefilter is transparent.
glm::vec4 samplePrefilter(const AssetView& asset, glm::vec2 st, const glm::mat2& footprint,
                          Minification filter = Minification::Taps4, Wrap wrap = Wrap::Border);

}  // namespace vtm::asset
