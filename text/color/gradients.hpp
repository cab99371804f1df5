/// \file
/// Gradients of COLR version 1 as paints of scenes. Source: OpenType 1.9.1, table COLR, "Gradients".
#pragma once

#include <memory>
#include <optional>
#include <vector>
#include <vtm/scene/scene.hpp>

namespace vtm::text {

/// A colour line; offsets may lie outside [0, 1].
struct ColorLine {
    struct Stop {
        double offset;
        scene::Color color;
    };
    std::vector<Stop> stops;  ///< at least one, offsets do not decrease
    scene::Spread spread = scene::Spread::Pad;

    scene::Color at(double offset) const;
};

/// Colours along p0 to p1; those of the parallels to p0 p2 are the same. Nothing where it paints nothing.
std::optional<scene::Paint> linearGradient(const ColorLine& line, scene::Point p0, scene::Point p1,
                                           scene::Point p2);

/// Two circles. Nothing where it paints nothing and where scenes cannot say it: neither circle is in the
/// other.
struct Circle {
    scene::Point center;
    double radius;
};
std::optional<scene::Paint> radialGradient(const ColorLine& line, Circle first, Circle second);

/// A rectangle; that of no points is turned inside out.
struct Extent {
    scene::Point min, max;
};
/// Around the transformed points of a path, controls included.
Extent boundsOf(const scene::Path& path, const scene::Affine& transform);

struct ColoredPath {
    scene::Path path;
    scene::Color color;
};

/// What scenes have no paint for is cut into pieces of one colour each, in painter's order, which together
/// cover `extent`, all that the paint fills. A sweep: sectors of a degree, and cuts at the stops. Angles are
/// degrees, clockwise on the screen.
std::vector<ColoredPath> sweepGradient(const ColorLine& line, scene::Point center, double start, double end,
                                       const Extent& extent);
/// Two circles neither of which is in the other: discs.
std::vector<ColoredPath> coneGradient(const ColorLine& line, Circle first, Circle second,
                                      const Extent& extent);

}  // namespace vtm::text
