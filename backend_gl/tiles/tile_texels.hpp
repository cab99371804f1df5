/// \file
/// The texels of a tile, as tile.hpp describes them.
#pragma once

#include <glm/vec2.hpp>

#include "backend_gl/tiles/tile.hpp"

namespace vtm::gl {

using asset::Texel;

/// The two texels of a piece, whose numbers are rounded already.
Texel geometryTexel(const PlanarPiece& piece);
Texel colorTexel(const asset::Paint& left, const asset::Paint& right);

/// A cell's point with a known paint; `place` numbers it on the grid of such points, row by row.
struct Reference {
    glm::dvec2 point;
    unsigned place = 0;
    std::uint32_t paint = 0;
};

/// Writes cells, and the references for which they have no room.
class CellWriter {
public:
    CellWriter(std::span<const asset::Paint> paints, const std::vector<PlanarPiece>& pieces,
               std::vector<Texel>& texels)
        : paints_(paints), pieces_(pieces), texels_(texels) {}

    Texel write(const Reference& reference, std::span<const std::uint32_t> list);
    Texel writeCrowded(const Reference& reference) const;

private:
    Texel withoutReferences(const Reference& reference) const;
    std::uint32_t append(glm::dvec2 point, std::span<const std::uint32_t> list, bool wide);
    std::uint32_t referenceWord(std::uint32_t number, glm::dvec2 point) const;

    std::span<const asset::Paint> paints_;
    const std::vector<PlanarPiece>& pieces_;
    std::vector<Texel>& texels_;
};

}  // namespace vtm::gl
