/// \file
/// Paper mode: an item's outline as chords in its mask's unit square.
#pragma once

#include <cstdint>
#include <vector>

#include <vtm/scene/affine.hpp>
#include <vtm/scene/path.hpp>

namespace vtm::paper {

using scene::Point;

struct Chord {
    Point a, b;
    std::uint32_t contour = 0;
};

/// Closed contours, each a run of consecutive chords.
struct Outline {
    std::vector<Chord> chords;
    scene::FillRule rule = scene::FillRule::NonZero;

    bool isInside(int winding) const {
        return rule == scene::FillRule::NonZero ? winding != 0 : winding % 2 != 0;
    }
};

/// Cross product of b - a and p - a: above zero left of a to b, for y up.
double orient(Point a, Point b, Point p);

/// By how much the winding number grows from `from` to `to` where they cross chords. Vertices are counted
/// once, whichever chord they end.
int windingChange(const Outline& outline, const std::vector<std::uint32_t>& chords, Point from, Point to);

/// Winding number at a point, from all chords.
int windingAt(const Outline& outline, Point p);

/// A square of the picture.
struct Placement {
    Point min{0};
    double side = 0;
};

/// The square for a mask of `path`, within the picture `size`: it leaves 1/16 of its side free all round,
/// so that pixels beyond the outline see it. Side 0 where nothing of the path is in the picture.
Placement placeMask(const scene::Path& path, const scene::Affine& toPicture, Point size);

/// `path` in the unit square of its mask. Chords lie within `tolerance` (of the square's side) of their
/// curves, but where these leave the square.
Outline outlineInMask(const scene::Path& path, const scene::Affine& toPicture, scene::FillRule rule,
                      const Placement& placement, double tolerance);

}  // namespace vtm::paper
