/// \file
/// Strokes as edges.
///
/// SVG 2 section 13.5: a stroke is the area that a segment of the line's width, across the line, sweeps
/// as it moves along, plus joins and caps. It is added as many simple polygons, one for each step,
/// join and cap, all turning the same way, so that their union is what has a non-zero winding.
#pragma once

#include <vtm/scene/stroke.hpp>
#include "conformance/reference/outline/edges.hpp"

namespace vtm::reference {

/// The edges of a path's stroke, to be filled non-zero.
void addStroke(const scene::Path& path, const scene::StrokeStyle& style, const Affine& toPixels,
               const View& view, double flatness, int shape, EdgeList& edges);

}  // namespace vtm::reference
