/// \file
/// The families of hard scenes, by the file that draws them. Each is a function of its seed.
#pragma once

#include <cstdint>
#include <memory>
#include <numbers>
#include <utility>

#include <vtm/scene/scene.hpp>
#include "conformance/generate/src/random.hpp"

namespace vtm::generate {

using std::numbers::pi;

inline scene::Point polar(scene::Point centre, double radius, double angle) {
    return centre + radius * scene::Point(std::cos(angle), std::sin(angle));
}
/// Turned by a quarter.
inline scene::Point across(scene::Point p) { return {-p.y, p.x}; }
/// Turned by `angle`, scaled by `sx` and `sy` first, about `centre`.
inline scene::Affine about(scene::Point centre, double angle, double sx, double sy) {
    const scene::Point x = sx * polar({}, 1, angle), y = sy * across(polar({}, 1, angle));
    return {x, y, centre - centre.x * x - centre.y * y};
}
inline void append(scene::Path& path, const scene::Path& more) {
    path.insert(path.end(), more.begin(), more.end());
}
scene::Path circle(scene::Point centre, scene::Point radii);

/// Drawn numbers must not depend on the order in which a compiler evaluates arguments: an expression draws
/// once, or within braces. Items are added to the root group unless they are drawn into another one.
class Sketch {
public:
    explicit Sketch(std::uint64_t seed, double width = 64, double height = 64)
        : random(seed), scene{width, height, {}} {}

    Random random;
    scene::Scene scene;

    double side() const { return std::max(scene.width, scene.height); }
    scene::Point size() const { return {scene.width, scene.height}; }
    /// In the picture, or a little outside.
    scene::Point point() { return random.point(-0.1, 1.1) * size(); }
    /// No nearer to the border than a share of the side.
    scene::Point inside(double margin = 0.2) { return random.point(margin, 1 - margin) * size(); }
    /// Opaque as often as not.
    scene::Color color();

    scene::Item& add(scene::Path path, std::variant<scene::FillRule, scene::StrokeStyle> geometry,
                     scene::Group* group = nullptr);
    scene::Item& fill(scene::Path path, scene::Group* group = nullptr) {
        return add(std::move(path), scene::FillRule::NonZero, group);
    }
    scene::Item& fillAny(scene::Path path, scene::Group* group = nullptr) {
        return add(std::move(path), random.any(scene::FillRule::EvenOdd), group);
    }
    /// Any join and cap, and a width between shares of a length; the picture's side unless one is given.
    scene::StrokeStyle style(double thinnest, double widest, double length);
    scene::StrokeStyle style(double thinnest, double widest) { return style(thinnest, widest, side()); }
    scene::Path anyCircle(double smallest = 0.05);
    scene::Path anyRectangle();
};

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
