/// \file
/// The families of hard scenes, by the file that draws them. Each is a function of its seed.
#pragma once

#include <cstdint>

#include <vtm/scene/scene.hpp>

namespace vtm::generate {

// fills.cpp: outlines
scene::Scene slivers(std::uint64_t seed);           ///< triangles and threads far longer than wide
scene::Scene fans(std::uint64_t seed);              ///< triangles about a point, abutting or overlapping
scene::Scene nearlyCoincident(std::uint64_t seed);  ///< copies of an outline, each moved by a hair
scene::Scene cusps(std::uint64_t seed);             ///< cubics at, just before and just after a cusp
scene::Scene concentric(std::uint64_t seed);        ///< rings, by both rules
scene::Scene selfOverlaps(std::uint64_t seed);      ///< stars, scribbles, outlines run twice and back
scene::Scene huge(std::uint64_t seed);              ///< outlines from 10^2 to 10^7 pictures away
scene::Scene tiny(std::uint64_t seed);           ///< shapes down to 10^-8 of the picture, alone and in crowds
scene::Scene hairlineGrids(std::uint64_t seed);  ///< many thin rectangles across each other
scene::Scene abutting(std::uint64_t seed);       ///< tiles with common borders, cut at other places

// strokes.cpp
scene::Scene hairlines(std::uint64_t seed);       ///< strokes down to 10^-7 of the picture
scene::Scene dashes(std::uint64_t seed);          ///< lengths of zero, odd numbers of them, any offset
scene::Scene strokedArcs(std::uint64_t seed);     ///< widths about the arcs' radii
scene::Scene turningMiters(std::uint64_t seed);   ///< miter joins at lines that turn back, or nearly
scene::Scene emptySegments(std::uint64_t seed);   ///< segments of no length between others, and alone
scene::Scene strokedCurves(std::uint64_t seed);   ///< wide strokes along tight curves
scene::Scene extremeStrokes(std::uint64_t seed);  ///< widths and miter limits from 10^-6 to 10^6
scene::Scene pens(std::uint64_t seed);            ///< strokes under transforms that make the pen an ellipse

// layers.cpp: transforms, clips, groups and paints
scene::Scene transforms(std::uint64_t seed);   ///< shear, mirrors, nearly flat, of outlines that undo them
scene::Scene nestedClips(std::uint64_t seed);  ///< clips of clips, of shapes that are clipped
scene::Scene blends(std::uint64_t seed);       ///< groups in groups with opacity and every blend mode
scene::Scene crowds(std::uint64_t seed);       ///< many translucent layers over each other
scene::Scene selections(std::uint64_t seed);   ///< one of two groups at every point
scene::Scene masks(std::uint64_t seed);        ///< groups under masks of groups, of both kinds
scene::Scene patterns(std::uint64_t seed);     ///< tiles that abut, turned and sheared
scene::Scene hardStops(std::uint64_t seed);    ///< gradients with jumps
scene::Scene ramps(std::uint64_t seed);        ///< smooth gradients

// lattice.cpp: where the compiler's own borders and points lie
scene::Scene cellBorders(std::uint64_t seed);   ///< edges on, and a hair beside, dyadic lines
scene::Scene cellCorners(std::uint64_t seed);   ///< vertices at and diagonals through cells' corners
scene::Scene borderRuns(std::uint64_t seed);    ///< edges that run along a border in small steps
scene::Scene borderCurves(std::uint64_t seed);  ///< curves whose extrema, inflections and ends lie on borders
scene::Scene latticeSteps(std::uint64_t seed);  ///< shapes a few steps of the lattice in size and apart
scene::Scene longPictures(std::uint64_t seed);  ///< up to 10^5 times as long as wide
scene::Scene scaledPictures(std::uint64_t seed);  ///< 10^-9 to 10^9 units a side
scene::Scene farArcs(std::uint64_t seed);         ///< pieces of arcs and curves of radii up to 10^7

}  // namespace vtm::generate
