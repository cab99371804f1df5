/// \file
/// Lengths, points and bounds of paths (specification sections 8.6.10 to 8.6.12).
#pragma once

#include <span>

#include "api/openvg/path/path_data.hpp"
#include "geometry/box.hpp"

namespace vtm::openvg {

/// Of the segments, moves counting nothing and closings as lines. Relative error below 1e-6.
double length(std::span<const Segment> segments);

struct PointOnPath {
    Point at{0}, tangent{1, 0};  ///< tangent: of length 1
};

/// The point `distance` along segments first to first + count - 1 of a path (section 8.6.11). The tangent is
/// the one that comes in, or goes out where none does, or (1, 0).
PointOnPath pointAlong(std::span<const Segment> segments, std::size_t first, std::size_t count,
                       double distance);

/// The tightest box around all points of a path's image, those of moves included.
geometry::Box bounds(std::span<const Segment> segments, const glm::mat3& affine);

}  // namespace vtm::openvg
