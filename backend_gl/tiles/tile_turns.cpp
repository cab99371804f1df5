#include "backend_gl/tiles/tile_turns.hpp"

#include <algorithm>

namespace vtm::gl {

namespace {

/// A loop over the references of one texel, two at least, takes one turn more than there are references; and
/// the loop over texels takes one.
constexpr std::uint64_t turnsAPiece = 2;
/// The cell itself, and the last texel.
constexpr std::uint64_t turnsOfEnds = 4;

/// With programs, to find a piece and for both of its sides; in the quarters of a pixel a loop over the four,
/// too.
constexpr std::uint64_t wholeTurns = 3, quarterTurns = wholeTurns + 4;

/// Of a paint that is drawn: the loop that draws it, once for the pixel and, where it is steep, for each
/// quarter.
std::uint64_t paintTurns(const PaintCosts& costs, std::uint32_t paint) {
    const std::uint64_t once = 1 + costs.turns[paint], whole = 1 + once, quarters = 1 + 4 * once;
    return whole + (costs.mayBeSteep(paint) ? quarters : 0);
}

}  // namespace

std::uint64_t solidTurns(std::size_t pieces) { return turnsAPiece * pieces + turnsOfEnds; }

/// A paint is drawn when two others have come after it. What comes is the first paint, and those of each run
/// of pieces between the same two; a pixel for which some pieces do not matter sees no more of such runs.
std::uint64_t turnsWithPrograms(const PaintCosts& costs, std::uint32_t paint,
                                const std::vector<asset::PlanarPiece>& pieces,
                                std::span<const std::uint32_t> list) {
    std::uint64_t sum =
        turnsOfEnds * (wholeTurns + quarterTurns) + paintTurns(costs, paint) + wholeTurns * list.size();
    bool steep = false;
    const asset::PlanarPiece* last = nullptr;
    for (const std::uint32_t i : list) {
        const asset::PlanarPiece& piece = pieces[i];
        if (!last || std::minmax(piece.left, piece.right) != std::minmax(last->left, last->right))
            sum += paintTurns(costs, piece.left) + paintTurns(costs, piece.right);
        steep = steep || costs.mayBeSteep(piece.left) || costs.mayBeSteep(piece.right);
        last = &piece;
    }
    return sum + (steep ? quarterTurns * list.size() : 0);
}

}  // namespace vtm::gl
