/// \file
/// The patterns whose tiles' content is being lowered, from outside in; an item of that content in, its
/// outline in all tiles out.
#pragma once

#include <optional>
#include <vector>

#include <vtm/scene/paint.hpp>
#include "compiler/lower/error_budget.hpp"
#include "compiler/lower/lattice.hpp"
#include "compiler/lower/outline.hpp"
#include "compiler/lower/outline_cache.hpp"
#include "compiler/patterns/tile_range.hpp"
#include "compiler/patterns/tiled_outline.hpp"

namespace vtm::compiler {

class TilingStack {
public:
    /// Both must outlive it. A step of the tiles' lattices is at most a `fineness` of one of the picture's,
    /// where tiles are no larger than mostTileSide / fineness of these.
    TilingStack(const Lattice& lattice, const ErrorBudget& budget, double fineness)
        : lattice_(lattice), budget_(budget), fineness_(fineness) {}

    /// Of a tile, in steps.
    static constexpr Coord leastTileSide = 1 << 10, mostTileSide = 1 << 28;

    bool empty() const { return levels_.empty(); }
    const Tiling& innermost() const { return levels_.back().tiling; }

    /// Whether the picture's step says how exact outlines are.
    bool isFine(const scene::Pattern& pattern, const scene::Affine& toPicture) const {
        return fineness_ * longerSideOf(pattern, scene::compose(lattice_.toSteps(), toPicture)) <=
               mostTileSide;
    }

    /// Goes on with the content of a pattern's tiles, the `rows` of a range, which `toOutside` leads to steps
    /// of the lattice around them. Returns what leads from the pattern's space to the lattice of tile (0, 0);
    /// nothing, and does not go on, if tiles are flat.
    std::optional<scene::Affine> enter(const scene::Pattern& pattern, const TileRange& range,
                                       std::vector<TileSpan> rows, const scene::Affine& toOutside);
    void leave() { levels_.pop_back(); }

    /// Appends an outline; its origin's transform leads to the innermost tile. A stroke beyond the limits is
    /// a LimitError, and then nothing is appended.
    void append(Outlines& outlines, const OutlineOrigin& origin) const;

private:
    struct Level {
        Tiling tiling;
        scene::Affine toSteps;  ///< from its lattice to the picture's
        double stretch = 1;     ///< at most
    };

    void appendInTile(Outlines& outlines, const OutlineOrigin& origin) const;

    const Lattice& lattice_;
    const ErrorBudget& budget_;
    const double fineness_;
    std::vector<Level> levels_;
};

}  // namespace vtm::compiler
