/// \file
/// The backend's four programs.
#pragma once

#include <array>

#include "backend_gl/src/program.hpp"

namespace vtm::gl {

/// Leaf programs by what a square of the tree costs.
enum class CostClass : unsigned {
    Solid,   ///< one colour
    Pieces,  ///< regions of solid colours
    General  ///< paint programs
};
inline constexpr unsigned costClassCount = 3;

/// Texture units, the same in every program.
enum class Unit : int { Texels, Images, Placements, Layer, Backdrop };

struct Programs {
    Programs();

    const Program& of(CostClass cost) const;
    /// The composite program last.
    std::array<const Program*, 4> all() const { return {&solid, &pieces, &general, &composite}; }

    Program solid, pieces, general, composite;
};

}  // namespace vtm::gl
