/// \file
/// Paths under projective maps, clipped by lines of the surface (VG_NDS_projective_geometry, sections 6.5
/// and 7.a). Clipping happens before the division by w.
#pragma once

#include <span>
#include <vector>

#include <glm/mat3x3.hpp>

#include "api/openvg/image/pixels.hpp"
#include "api/openvg/path/segment.hpp"
#include "api/openvg/state/state.hpp"

namespace vtm::openvg {

/// (a, b, c): the side where a w x + b w y + c w >= 0 is kept.
using ClipLine = glm::dvec3;

/// Those of the state; none where its mode is that of none.
std::vector<ClipLine> clipLines(const State& state);

struct RationalSubpath {
    glm::dvec3 start{0};
    std::vector<RationalCurve> curves;
    bool isClosed = false;  ///< by a line that is not among the curves
};
using RationalPath = std::vector<RationalSubpath>;

RationalPath mapped(const std::vector<Segment>& segments, const glm::mat3& toSurface);

/// True if no point is beyond any of the lines.
bool isWithin(const RationalPath& path, std::span<const ClipLine> lines);

/// As an area: what is beyond is replaced by lines along the clip lines, so that winding numbers before them
/// stay.
RationalPath clippedArea(RationalPath path, std::span<const ClipLine> lines);
/// As a line: what is beyond is left out.
RationalPath clippedLine(RationalPath path, std::span<const ClipLine> lines);

/// An outline in surface coordinates, as an area: what may be seen of it in `clip` before all of the lines
/// and the viewer (w > 0). Off by a 256th of a pixel.
scene::Path projectedOutline(const scene::Path& outline, const glm::mat3& toSurface,
                             std::span<const ClipLine> lines, const Rectangle& clip);

/// vgTransformPath by a projective map, or with clip lines: absolute segments, arcs as rational curves.
std::vector<Segment> projectedSegments(const std::vector<Segment>& segments, const glm::mat3& toSurface,
                                       const State& state);

}  // namespace vtm::openvg
