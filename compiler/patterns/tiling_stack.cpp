#include "compiler/patterns/tiling_stack.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vtm::compiler {

using scene::Affine;
using scene::compose;
using scene::Point;

std::optional<Affine> TilingStack::enter(const scene::Pattern& pattern, const TileRange& range,
                                         std::vector<TileSpan> rows, const Affine& toOutside) {
    const Affine toSteps = empty() ? toOutside : compose(levels_.back().toSteps, toOutside);
    const double least = fineness_ * longerSideOf(pattern, toSteps);
    Coord side = leastTileSide;
    while (side < least && side < mostTileSide)
        side *= 2;
    const Point period = pattern.max - pattern.min, step = period / double(side),
                corner = pattern.min + range.first * period;
    const Affine fromTiles{step.x, 0, 0, step.y, corner.x, corner.y};
    Level level{{side, std::move(rows), compose(toOutside, fromTiles)}, compose(toSteps, fromTiles)};
    level.stretch = largestStretch(level.toSteps);
    if (!(level.stretch > 0 && std::isfinite(level.stretch)))
        return std::nullopt;
    levels_.push_back(std::move(level));
    return Affine{1 / step.x, 0, 0, 1 / step.y, -pattern.min.x / step.x, -pattern.min.y / step.y};
}

void TilingStack::append(Outlines& outlines, const OutlineOrigin& origin) const {
    Outlines made;
    appendInTile(made, origin);
    for (std::size_t i = levels_.size() - 1; i > 0; --i) {
        const Tiling& around = levels_[i - 1].tiling;
        Outlines tiles;
        addTiled(tiles, made, levels_[i].tiling, around.tileMin(), around.tileMax());
        made = std::move(tiles);
    }
    addTiled(outlines, made, levels_.front().tiling, lattice_.clampMin(), lattice_.clampMax());
}

void TilingStack::appendInTile(Outlines& outlines, const OutlineOrigin& origin) const {
    const Level& level = levels_.back();
    const Tiling& tiling = level.tiling;
    const auto inTile = [&](ChordTolerance tolerance) { return tolerance.scaled(1 / level.stretch); };
    if (!origin.stroke)
        return addOutline(outlines, *origin.path, origin.transform, inTile(budget_.fillChords()),
                          tiling.tileMin(), tiling.tileMax());
    const double stretch = largestStretch(compose(level.toSteps, origin.transform));
    if (stretch > 0 && std::isfinite(stretch))
        addStroke(outlines, *origin.path, *origin.stroke, budget_.strokeOutline() / stretch,
                  budget_.strokeChords().scaled(1 / stretch), origin.transform,
                  inTile(budget_.strokeChords()), tiling.tileMin(), tiling.tileMax());
}

}  // namespace vtm::compiler
