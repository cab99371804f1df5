#include "backend_gl/src/patch_turns.hpp"

#include <algorithm>

namespace vtm::gl {

namespace {

/// A loop over the references of one texel, two at least, takes one turn more than there are references; and
/// the loop over texels takes one.
constexpr std::uint64_t turnsAPiece = 2;
/// The cell itself, and the last texel.
constexpr std::uint64_t turnsOfEnds = 4;

/// With programs, in the whole pixel: to find a piece, and for both of its sides.
constexpr std::uint64_t wholeTurns = 3;
/// In the quarters the same, and a loop over the four.
constexpr std::uint64_t quarterTurns = wholeTurns + 4;

/// A paint that is drawn: the loop that draws it, then once for the pixel and once for each quarter.
std::uint64_t paintTurns(std::uint64_t program) { return (1 + 1 + program) + (1 + 4 * (1 + program)); }

}  // namespace

std::uint64_t solidTurns(std::size_t pieces) { return turnsAPiece * pieces + turnsOfEnds; }

/// A paint is drawn when two others have come after it. What comes is the first paint, and those of each run of
/// pieces between the same two; a pixel for which some pieces do not matter sees no more of such runs.
std::uint64_t turnsWithPrograms(std::span<const std::uint32_t> turns, std::uint32_t paint,
                           const std::vector<asset::PlanarPiece>& pieces,
                           std::span<const std::uint32_t> list) {
    std::uint64_t sum = turnsOfEnds * (wholeTurns + quarterTurns) + paintTurns(turns[paint]) +
                        (wholeTurns + quarterTurns) * list.size();
    const asset::PlanarPiece* last = nullptr;
    for (const std::uint32_t i : list) {
        const asset::PlanarPiece& piece = pieces[i];
        const bool goesOn = last && std::minmax(piece.left, piece.right) == std::minmax(last->left, last->right);
        if (!goesOn)
            sum += paintTurns(turns[piece.left]) + paintTurns(turns[piece.right]);
        last = &piece;
    }
    return sum;
}

}  // namespace vtm::gl
