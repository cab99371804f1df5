#include "backend_gl/tiles/tile_turns.hpp"

#include <algorithm>

namespace vtm::gl {

namespace {

/// tile_fragment.glsl: a loop over the references of one texel, two at least, takes one turn more than there
/// are references; and the loop over texels takes one.
constexpr std::uint64_t turnsPerPiece = 2;
/// The cell itself, and the last texel.
constexpr std::uint64_t turnsOfEnds = 4;

/// tile_programs_fragment.glsl: the pixel and its quarters.
constexpr std::uint64_t partCount = 5;
/// A turn of the outer loop takes one of the inner loop at least, even if it adds no piece.
constexpr std::uint64_t outerTurns = 2;

/// Of a share of a paint: it is shaded once for the pixel and, where it is steep, for each quarter.
std::uint64_t paintTurns(const PaintCosts& costs, std::uint32_t paint) {
    return (outerTurns + costs.turns[paint]) * (costs.mayBeSteep(paint) ? partCount : 1);
}

}  // namespace

std::uint64_t solidTurns(std::size_t pieces) { return turnsPerPiece * pieces + turnsOfEnds; }

/// A share is shaded when two other paints have come after it. What comes is the first paint, and those of
/// each run of pieces between the same two; a pixel for which some pieces do not matter sees no more of such
/// runs. At its end each part takes one outer turn more, which may shade nothing.
std::uint64_t turnsWithPrograms(const PaintCosts& costs, std::uint32_t paint,
                                const std::vector<asset::PlanarPiece>& pieces,
                                std::span<const std::uint32_t> list) {
    std::uint64_t sum = outerTurns * partCount + paintTurns(costs, paint);
    bool steep = false;
    const asset::PlanarPiece* last = nullptr;
    for (const std::uint32_t i : list) {
        const asset::PlanarPiece& piece = pieces[i];
        if (!last || std::minmax(piece.left, piece.right) != std::minmax(last->left, last->right))
            sum += paintTurns(costs, piece.left) + paintTurns(costs, piece.right);
        steep = steep || costs.mayBeSteep(piece.left) || costs.mayBeSteep(piece.right);
        last = &piece;
    }
    return sum + list.size() * (steep ? partCount : 1);
}

}  // namespace vtm::gl
