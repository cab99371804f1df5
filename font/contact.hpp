/// \file
/// Whether outlines touch: then one map must hold both, or pixels would count what they share twice.
#pragma once

#include <vector>

#include <vtm/scene/path.hpp>
#include "geometry/box.hpp"

namespace vtm::font {

/// An outline as closed polygons.
struct Polygons {
    explicit Polygons(const scene::Path& path);

    std::vector<std::vector<scene::Point>> rings;
    geometry::Box box;
};

/// Whether one of them, moved by `by`, and the other have a point in common; both NonZero filled.
bool touch(const Polygons& moved, scene::Point by, const Polygons& other);

}  // namespace vtm::font
