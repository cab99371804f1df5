#include "svg/geometry/bounds.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <vtm/limits/limits.hpp>

namespace vtm::svg {
namespace {

/// Share of the box's size by which an outline may stand over without being worth a clip: below what
/// an 8-bit pixel of the largest target shows, above the noise of decimal path data.
constexpr double tolerance = 1e-6;

/// How far a stroke reaches from its path at most, times half its width.
double reach(const scene::StrokeStyle& stroke) {
    const bool miter = stroke.join == scene::Join::Miter || stroke.join == scene::Join::MiterClip;
    return std::max(miter ? stroke.miterLimit : 1.0, std::numbers::sqrt2);
}

Box itemBox(const scene::Item& item, const scene::Affine& transform) {
    const scene::Affine map = scene::compose(transform, item.transform);
    Box box = boundingBox(*item.path, map);
    if (const auto* stroke = std::get_if<scene::StrokeStyle>(&item.geometry)) {
        const scene::Point growth =
            0.5 * stroke->width * reach(*stroke) *
            scene::Point(std::hypot(map[0].x, map[1].x), std::hypot(map[0].y, map[1].y));
        box.min -= growth;
        box.max += growth;
    }
    return box;
}

}  // namespace

bool liesInside(const std::vector<scene::Node>& nodes, const scene::Affine& transform, const Box& box) {
    const scene::Point margin = tolerance * scene::Point(box.width(), box.height());
    const Box grown{box.min - margin, box.max + margin};
    return std::all_of(nodes.begin(), nodes.end(), [&](const scene::Node& node) {
        limits::check();
        if (const auto* item = std::get_if<scene::Item>(&node.value))
            return grown.contains(itemBox(*item, transform));
        return liesInside(std::get<scene::Group>(node.value).children, transform, box);
    });
}

Box boxOf(const scene::Item& item) { return itemBox(item, scene::identity); }

Box boxAround(const std::vector<scene::Node>& nodes) {
    Box box;
    for (const scene::Node& node : nodes) {
        limits::check();
        const auto* item = std::get_if<scene::Item>(&node.value);
        box.add(item ? itemBox(*item, scene::identity)
                     : boxAround(std::get<scene::Group>(node.value).children));
    }
    return box;
}

}  // namespace vtm::svg
