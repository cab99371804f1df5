/// \file
/// Placements in, fewer out: what stands together again and again becomes a map of maps.
#pragma once

#include <glm/vec2.hpp>

#include "compiler/instances/placed_symbols.hpp"

namespace vtm::compiler {

/// Groups of placements that are images of each other, groups of groups included. What an instance adds to a
/// pixel does not depend on the map that places it, so nothing but their places has to be proven: each may
/// move by `slack` in user units. `size`: of the picture.
PlacedSymbols groupPlacements(PlacedSymbols placed, double slack, glm::dvec2 size);

}  // namespace vtm::compiler
