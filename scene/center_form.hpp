/// \file
/// A path's arcs by their centre.
#pragma once

#include <optional>

#include <vtm/scene/path.hpp>

#include "geometry/arc.hpp"

namespace vtm::scene {

/// Nothing where the arc, which starts at `from`, is a straight line or nothing at all
/// (geometry::centerForm).
inline std::optional<geometry::EllipticalArc> centerForm(Point from, const ArcTo& arc) {
    return geometry::centerForm({from, arc.radii, arc.rotation, arc.largeArc, arc.sweep, arc.to});
}

}  // namespace vtm::scene
