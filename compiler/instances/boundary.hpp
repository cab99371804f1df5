/// \file
/// A symbol's boundaries, for asking whether something else touches them or lies in one of its regions.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "raster/planar_map.hpp"

namespace vtm::compiler {

struct Segment2 {
    glm::dvec2 a, b;
};

/// In sides of the symbol's square.
class SymbolBoundary {
public:
    explicit SymbolBoundary(const asset::PlanarMap& map);

    std::span<const Segment2> segments() const { return segments_; }
    glm::dvec2 min() const { return min_; }
    glm::dvec2 max() const { return max_; }
    /// Whether a segment meets one of the boundary's.
    bool meets(Segment2 s) const;
    /// The number of the region at a point; 0 outside.
    std::uint32_t regionAt(glm::dvec2 p) const { return index_.paintAt(p * index_.map().extent); }
    /// A point in a region beside each connected part of the boundary. Empty if none was found for one of
    /// them.
    std::vector<glm::dvec2> pointsInside() const;

private:
    template <class Visit>
    void forEachCell(Segment2 s, Visit&& visit) const;

    asset::PlanarIndex index_;
    std::vector<Segment2> segments_;
    glm::dvec2 min_, max_;
    int cells_;                                     ///< a side
    std::vector<std::vector<std::uint32_t>> grid_;  ///< segments by cell
};

}  // namespace vtm::compiler
