/// \file
/// Minification: pyramids of exact means, built from exact coverage, and the filter that samples them.
/// Masks cannot be averaged and composited afterwards, so what is averaged is the composited,
/// premultiplied colour.
/// Sources: Ray et al. 2005 (mipmap of the classification function); the rest is ours: docs/prefilter.md.
#pragma once

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <vtm/asset/asset.hpp>

#pragma GCC visibility push(default)

namespace vtm::asset {

// ---- Building -------------------------------------------------------------------------------------

struct PrefilterOptions {
    /// Squares that a footprint may meet on average, where it meets a leaf with pieces at all, and still
    /// be drawn from the tree: somewhat fewer than the 2 × 2 that a footprint as large as a leaf may meet,
    /// since leaves have many pieces.
    double squaresPerFootprint = 3.6;
    /// Upper limit of a side, texels; at most maxPyramidSide.
    std::uint32_t largestSide = 512;
    /// Number of threads; 0: one per core. The result does not depend on it.
    unsigned threads = 0;
};

/// The size that a picture needs: a base texel is half a footprint that meets too many squares. A tiny
/// grid for a simple picture, and (1, 1) for a flat one.
PyramidSize prefilterSize(const AssetView& asset, const PrefilterOptions& options = {});

/// Each texel is the mean of the picture over it, rounded once, to the nearest 255th: exact for solid paints,
/// by the evaluator's rules (on a grid four times finer) for gradients, images and groups. Throws
/// std::invalid_argument if an option is out of range.
Prefilter buildPrefilter(const AssetView& asset, const PrefilterOptions& options = {});
/// Builds a pyramid of the given size. Throws std::invalid_argument if isPyramidSide rejects a side.
Prefilter buildPrefilter(const AssetView& asset, PyramidSize size, unsigned threads = 0);

// ---- Sampling -------------------------------------------------------------------------------------

enum class Minification {
    Trilinear,  ///< one tap where a texel is as large as the footprint
    Taps2,      ///< 2 × 2 taps, texels half as large
    Taps4       ///< 4 × 4 taps, texels a quarter as large
};

enum class Wrap {
    Border,  ///< transparent beyond the picture, as the evaluator has it
    Clamp,   ///< its border's texels go on
    Repeat,  ///< the picture repeats
    Mirror   ///< and every other copy is mirrored
};

/// Base texels that a footprint is wide where the tree alone draws, and where the prefilter alone does.
inline constexpr float fadeFrom = 2, fadeTo = 4;

/// How much of a footprint's colour the prefilter should give, in [0, 1]: rising over the octave from
/// fadeFrom to fadeTo, at whose end the 4 × 4 taps find texels as fine as they want. The rest is drawn from
/// the tree.
float prefilterShare(const AssetView& asset, const glm::mat2& footprint);

/// Max number of sub-footprints along the longer axis of a footprint.
inline constexpr int largestAnisotropy = 4;

/// Mean colour, premultiplied, over the parallelogram round `st` with the sides footprint[0] and
/// footprint[1]: where a pixel lies in the picture, both in shares of its width and height.
/// An asset without prefilter is transparent.
glm::vec4 samplePrefilter(const AssetView& asset, glm::vec2 st, const glm::mat2& footprint,
                          Minification filter = Minification::Taps4, Wrap wrap = Wrap::Border);

}  // namespace vtm::asset

#pragma GCC visibility pop
