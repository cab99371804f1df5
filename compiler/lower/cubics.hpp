/// \file
/// A path's outline as straight lines and cubic Béziers.
#pragma once

#include <limits>

#include <vtm/scene/affine.hpp>
#include <vtm/scene/path.hpp>
#include "geometry/cubic.hpp"

namespace vtm::compiler {

using geometry::Cubic;

/// Receives closed contours: start, then lines and cubics, each from where the last one ended; the
/// last one of a contour ends at its start.
class CurveSink {
public:
    virtual ~CurveSink() = default;
    virtual void start(scene::Point p) = 0;
    virtual void line(scene::Point to) = 0;
    virtual void cubic(const Cubic& c) = 0;
};

/// Coordinates of the map beyond this are pulled in to it, far outside any picture, so that
/// differences and products stay finite.
inline constexpr double farAway = 1e100;
scene::Affine withoutFarAway(scene::Affine map);

/// Walks `path` under `map`; open subpaths are closed by a line. Quadratics are raised to cubics,
/// exactly; elliptical arcs become cubics of a 32nd of a turn at most, within 1.1e-9 of their radius and
/// within `arcTolerance` under the map.
void walkCurves(const scene::Path& path, const scene::Affine& map, CurveSink& sink,
                double arcTolerance = std::numeric_limits<double>::infinity());

}  // namespace vtm::compiler
