/// \file
/// Scene in, Vector Texture Map out: regions, cells, tree, encode.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <vtm/asset/asset.hpp>
#include <vtm/error.hpp>
#include <vtm/scene/scene.hpp>

#pragma GCC visibility push(default)

namespace vtm::compiler {

struct Options {
    asset::Mode mode = asset::Mode::Exact;
    /// Largest distance between a drawn boundary and the scene's, as a share of the picture's longer
    /// side. In [2^-26, 2^-6]; below 2^-24 it is aimed at but not proven (Result::provenError).
    double tolerance = 1.0 / 65536;
    /// How large an asset may get for being drawn fast: the nanoseconds of drawing at 1024 pixels (of a
    /// software rasteriser, docs/regions.md) that are worth a byte. Cells are split or not, and lists of
    /// pieces long or short, as this makes cheapest. In [1, 1e6].
    double nanosecondsPerByte = 700;
    /// A fixed rule instead, for comparison: a leaf with more pieces is split while the tree may grow
    /// deeper. In [1, 4096].
    std::optional<unsigned> piecesPerLeaf = std::nullopt;
    /// Levels of the 16-tree, at most. In [0, asset::maxLevel]. Below level 8 there are only leaves that were
    /// not proven to be within the tolerance where they were larger.
    unsigned maxDepth = asset::maxLevel;
    /// Pairs of chords looked at before the picture is a LimitError: a minute or so.
    std::size_t maxWork = 20'000'000'000;
};

/// Milliseconds of wall time a stage took.
struct StageTime {
    std::string stage;
    double milliseconds;
};

/// A square of the picture, picture units.
struct UnprovenSquare {
    double x, y, side;
};

struct Result {
    asset::Asset asset;
    /// No drawn boundary lies farther from the scene's than this share of the picture's longer side: what
    /// is farther from every outline that shows has its true colour. docs/regions.md says what is
    /// proven and how. 0 where nothing is drawn but whole squares. Beyond the tolerance only where the
    /// warnings say so: it is finer than can be proven, or outlines are too tangled for leaves that may be
    /// made.
    double provenError = 0;
    /// Leaves filled with the mean of samples (Asset::fallbackLeaves) that are too large for the tolerance:
    /// no boundary is told apart within them.
    std::vector<UnprovenSquare> unproven;
    /// Strokes along curves other than circles. Where such a curve is tighter than half the stroke's width,
    /// that its offset curves lie within the tolerance is tested at fifteen points of every piece, not proven
    /// between them. Where it is gentler that is proven, too, as is everything after.
    std::size_t sampledStrokes = 0;
    std::vector<StageTime> stages;      ///< in order: lower, push, planarise, fit, encode
    std::vector<std::string> warnings;  ///< what a limit took away or an approximation changed
};

/// The scene asks for more than a stated limit allows; says which.
class LimitError : public Error {
    using Error::Error;
};

/// Throws scene::InvalidScene, LimitError, std::invalid_argument (options out of range).
Result compile(const scene::Scene& scene, const Options& options = {});

}  // namespace vtm::compiler

#pragma GCC visibility pop
