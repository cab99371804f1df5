#include "compiler/instances/outline_box.hpp"

#include <cmath>

#include "geometry/cubic.hpp"
#include "scene/center_form.hpp"
#include "scene/stroke_reach.hpp"

namespace vtm::compiler {
namespace {

using geometry::Box;
using scene::Point;

Box pathBox(const scene::Path& path, const scene::Affine& transform) {
    const auto mapped = [&](Point p) { return scene::apply(transform, p); };
    Box box;
    Point last(0);
    for (const scene::Command& command : path) {
        if (const auto* quad = std::get_if<scene::QuadTo>(&command)) {
            box.add(
                geometry::bounds(geometry::raised(mapped(last), mapped(quad->control), mapped(quad->to))));
        } else if (const auto* cubic = std::get_if<scene::CubicTo>(&command)) {
            box.add(geometry::bounds(
                {mapped(last), mapped(cubic->control1), mapped(cubic->control2), mapped(cubic->to)}));
        } else if (const auto* arc = std::get_if<scene::ArcTo>(&command)) {
            if (const auto center = scene::centerForm(last, *arc))
                box.add(geometry::bounds(geometry::mapped(*center, transform)));
        }
        if (const auto end = scene::endOf(command)) {
            last = *end;
            box.add(mapped(last));
        }
    }
    return box;
}

}  // namespace

Box outlineBox(const LayerOrigin& origin) {
    Box box = pathBox(*origin.path, origin.transform);
    if (origin.stroke && !box.empty()) {
        // What a disc of radius 1 becomes reaches as far along each axis.
        const scene::Affine& m = origin.transform;
        const Point reach = scene::strokeReach(*origin.stroke) *
                            Point(std::hypot(m[0].x, m[1].x), std::hypot(m[0].y, m[1].y));
        box.min -= reach;
        box.max += reach;
    }
    return box;
}

}  // namespace vtm::compiler
