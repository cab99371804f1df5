/// \file
/// The pieces of a tile.
#pragma once

#include <cmath>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include "backend_gl/tiles/tile.hpp"

namespace vtm::gl {

/// Of a slope as tiles store it.
inline int slopeSteps(double slope) {
    return int(std::lround(glm::clamp(slope, -1.0, 1.0) * tileSlopeScale));
}

/// Pieces as the shader will know them: in tile coordinates, rounded.
class LocalPieces {
public:
    LocalPieces(double extent, const TilePlace& place, double margin,
                std::span<const PlanarPiece* const> near);

    const std::vector<PlanarPiece>& pieces() const { return pieces_; }
    glm::dvec2 toLattice(glm::dvec2 local) const { return corner_ + local * side_; }
    /// In tile coordinates, not rounded.
    PlanarPiece toTile(const PlanarPiece& piece) const;

private:
    void add(const PlanarPiece& piece);
    double longestBend(const PlanarPiece& piece, double length) const;
    void addRounded(PlanarPiece piece);

    double side_;
    glm::dvec2 corner_;
    double margin_;
    std::vector<PlanarPiece> pieces_;
};

}  // namespace vtm::gl
