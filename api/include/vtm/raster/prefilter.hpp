/// \file
/// Minification: pyramids of exact means, built from exact coverage. `vtm_sample`
/// (vtm/gl/sampled_texture.hpp) samples them. Masks cannot be averaged and composited afterwards, so what is
/// averaged is the composited, premultiplied colour. Sources: Ray et al. 2005 (mipmap of the classification
/// function); the rest is ours: docs/prefilter.md.
#pragma once

#include <vtm/asset/asset.hpp>

#pragma GCC visibility push(default)

namespace vtm::asset {

// ---- Building -------------------------------------------------------------------------------------

struct PrefilterOptions {
    /// Squares that a footprint may meet on average, where it meets a leaf with pieces at all, and still
    /// be drawn from the tree: somewhat fewer than the 2 × 2 that a footprint as large as a leaf may meet,
    /// since leaves have many pieces. 2.4 makes small textured pictures up to 28 times as fast, for two to
    /// seven times the texels, and less exact where the filter then takes over (docs/prefilter.md).
    double squaresPerFootprint = 3.6;
    /// Where footprints meet few squares but take long (many pieces, paint programs), a finer base saves
    /// time. It takes at most so many times the bytes of the tree; 0: none. Pictures with images or materials
    /// have none.
    double timesTree = 12;
    /// Upper limit of a side, texels; at most maxPyramidSide.
    std::uint32_t largestSide = 512;
    /// Number of threads; 0: one per core. The result does not depend on it.
    unsigned threads = 0;
};

/// The size that a picture needs: a base texel is half a footprint that meets too many squares. A tiny
/// grid for a simple picture, and (1, 1) for a flat one.
PyramidSize prefilterSize(const AssetView& asset, const PrefilterOptions& options = {});

/// Each texel is the mean of the picture over it, rounded once, to the nearest 255th: exact for solid paints,
/// by the scanner on a grid four times finer for gradients, images and groups. Throws
/// std::invalid_argument if an option is out of range.
Prefilter buildPrefilter(const AssetView& asset, const PrefilterOptions& options = {});
/// Builds a pyramid of the given size. Throws std::invalid_argument if isPyramidSide rejects a side.
Prefilter buildPrefilter(const AssetView& asset, PyramidSize size, unsigned threads = 0);

// ---- Sampling -------------------------------------------------------------------------------------

enum class Wrap {
    Border,  ///< transparent beyond the picture, as the evaluator has it
    Clamp,   ///< its border's texels go on
    Repeat,  ///< the picture repeats
    Mirror   ///< and every other copy is mirrored
};

/// Base texels that a footprint is wide where the tree alone draws, and where the prefilter alone does.
/// Between them the prefilter's share rises with the logarithm; at its end 4 × 4 taps find texels nearly as
/// fine as they want.
inline constexpr float fadeFrom = 3, fadeTo = 3.75f;

}  // namespace vtm::asset

#pragma GCC visibility pop
