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
    /// Largest distance between a drawn boundary and the scene's, as a share of the picture's longer side. In
    /// [2^-26, 2^-6]. Below 2^-24 the compiler aims at it but cannot prove it (Result::provenError).
    double tolerance = 1.0 / 65536;
    /// The trade-off between drawing time and size of the asset: the nanoseconds of drawing at 1024 pixels
    /// (by a software rasteriser, docs/regions.md) that are worth one byte. The compiler splits cells where
    /// this makes the sum of both costs smallest. In [1, 1e6].
    double nanosecondsPerByte = 700;
    /// Replaces the cost model by a fixed rule, for comparison: splits every leaf with more pieces, down to
    /// maxDepth. In [1, 4096].
    std::optional<unsigned> piecesPerLeaf = std::nullopt;
    /// Max depth of the 16-tree. In [0, asset::maxLevel]. Leaves below level 8 exist only where a larger leaf
    /// could not be proven to be within the tolerance.
    unsigned maxDepth = asset::maxLevel;
    /// Whether what stands several times in the picture becomes a map of its own, which is placed
    /// (asset::Instance). Exact mode only.
    bool instances = true;
    /// 0: filters are computed when the picture is drawn, at the resolution of the view. Otherwise: what is
    /// filtered is drawn now, as an image of so many pixels along the picture's longer side, for what cannot
    /// run filters: textures in users' shaders. At most maxFilterPixels.
    unsigned filterPixels = 0;
    /// Max number of pairs of chords to test, about a minute of work; beyond it compile() throws LimitError.
    std::size_t maxWork = 20'000'000'000;
};

inline constexpr unsigned maxFilterPixels = 8192;

/// Wall time of a stage, milliseconds.
struct StageTime {
    std::string stage;
    double milliseconds;
};

/// A square with its min corner at (x, y), user units.
struct UnprovenSquare {
    double x, y, side;
};

struct Result {
    asset::Asset asset;
    /// Every drawn boundary lies within this share of the picture's longer side of the scene's boundary;
    /// points farther from every visible outline have their true colour. docs/regions.md says what is proven
    /// and how. 0 if only whole squares are drawn. Larger than the tolerance only with a warning: the
    /// tolerance is finer than can be proven, or the outlines are too tangled for the permitted leaves.
    double provenError = 0;
    /// Leaves filled with a mean of samples (Asset::fallbackLeaves) that are larger than the tolerance.
    /// Boundaries inside them are not resolved.
    std::vector<UnprovenSquare> unproven;
    /// Number of strokes along curves other than circles. Where such a curve is tighter than half the
    /// stroke's width, the error of its offset curves is tested at fifteen points of every piece and not
    /// proven between them. Elsewhere it is proven, as are all later stages.
    std::size_t sampledStrokes = 0;
    std::vector<StageTime> stages;      ///< in order: lower, divide, planarise, fit, encode
    std::vector<std::string> warnings;  ///< what a limit removed or an approximation changed
};

/// The scene exceeds a stated limit; the message says which.
class LimitError : public Error {
    using Error::Error;
};

/// Compiles a scene. Throws scene::InvalidScene, LimitError, std::invalid_argument (options out of range)
/// and, under a budget, limits::Exceeded.
Result compile(const scene::Scene& scene, const Options& options = {});

}  // namespace vtm::compiler

#pragma GCC visibility pop
