/// \file
/// A map's tree as the compiler has it, what it is built by, and the painters that its regions ask.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <vtm/asset/asset.hpp>
#include "compiler/cost.hpp"
#include "compiler/lower/error_budget.hpp"
#include "compiler/lower/lowered_scene.hpp"
#include "compiler/paint/palette.hpp"

namespace vtm::compiler {

/// Where a cell stands to a layer.
enum class Cover : std::uint8_t { Out, Edge, In };

/// What gives regions their paints, and tells which layers can be forgotten. Used by one thread at a time.
class Painter {
public:
    virtual ~Painter() = default;
    /// The same painter for another thread.
    virtual std::unique_ptr<Painter> clone() const = 0;
    /// The paint where exactly the given layers are inside; `layers` are those that may be, ascending.
    virtual PaintId paint(std::span<const std::uint32_t> layers, const std::vector<std::uint8_t>& inside,
                          Palette& palette) = 0;
    /// Clears keep[i] for each of the ascending `layers` that cannot show, where cover(layer) says how
    /// it covers the cell.
    virtual void cull(std::span<const std::uint32_t> layers, const std::vector<Cover>& covers,
                      std::vector<std::uint8_t>& keep) = 0;
    /// Mean of paints, for a leaf that could not be proven.
    virtual PaintId mean(std::span<const PaintId> paints, Palette& palette) = 0;
};

struct TreeOptions {
    explicit TreeOptions(const ErrorBudget& ofPicture) : budget(ofPicture) {}

    ErrorBudget budget;
    CostModel cost;
    /// Instead of the cost model: a leaf with more pieces is split.
    std::optional<unsigned> piecesPerLeaf;
    unsigned minDepth = 2;  ///< of leaves with pieces: keeps their quantisation below the tolerance
    unsigned maxDepth = 8;
    unsigned lastDepth = 8;   ///< of leaves that would not be within the tolerance on maxDepth
    std::size_t maxWork = 0;  ///< pairs of chords
};

/// Milliseconds of wall time: pushing, also above the blocks, planarising and fitting; and in all for
/// building blocks, which threads do at once, so that its wall time is shared out.
struct TreeTimes {
    double divide = 0, planarise = 0, fit = 0, all = 0;

    TreeTimes& operator+=(const TreeTimes& t) {
        divide += t.divide, planarise += t.planarise, fit += t.fit, all += t.all;
        return *this;
    }
    /// The same parts of `wall` in place of all.
    TreeTimes sharing(double wall) const {
        const double share = all > 0 ? wall / all : 0;
        return {divide * share, planarise * share, fit * share, wall};
    }
};

/// A map's tree, its places in walking order: a node comes before its children's nodes. Entries of
/// kind Solid hold a PaintId of `palette`.
struct Tree {
    struct Leaf {
        std::uint32_t firstPiece = 0, pieceCount = 0;
        std::array<PaintId, 4> corners{};
    };
    struct Piece {
        std::array<std::uint16_t, 2> a{}, b{};
        std::int16_t slopeA = 0, slopeB = 0;
        PaintId left = 0, right = 0;
    };
    asset::Entry root;
    std::vector<asset::Node> nodes;
    std::vector<Leaf> leaves;
    std::vector<Piece> pieces;
    Palette palette;
    double error = 0;              ///< the largest ErrorBudget::leaf or mean of the leaves
    std::vector<Square> unproven;  ///< leaves that are means of samples and too large for the tolerance
};

using Clock = std::chrono::steady_clock;

inline double milliseconds(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double, std::milli>(to - from).count();
}

}  // namespace vtm::compiler
