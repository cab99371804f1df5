/// \file
/// An outline in, its parts out: groups of contours that touch no others, as the dot of an i. Accented
/// letters share theirs with the plain ones, so each part is compiled once.
#pragma once

#include <vector>

#include <vtm/scene/path.hpp>

namespace vtm::font {

/// What tells a part from others: its commands and their points, bit for bit.
using PartKey = std::vector<double>;

struct Part {
    scene::Path path;  ///< its first point is (0, 0)
    scene::Point at;   ///< where that point stands in the outline

    PartKey key() const;
};

/// Of a path of closed subpaths without arcs; NonZero filled. Lengths are font units, `em` of them an em. One
/// of more parts than a glyph may have stays whole.
std::vector<Part> partsOf(const scene::Path& outline, double em);

/// A path's points times `scale`, plus `by`. Without arcs.
scene::Path mapped(const scene::Path& path, double scale, scene::Point by);

}  // namespace vtm::font
