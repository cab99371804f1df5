#include "bench/engines/shape.hpp"

#include <numbers>
#include <stdexcept>

#include "scene/center_form.hpp"

namespace vtm::bench {
namespace {

void collect(const scene::Group& group, std::vector<Shape>& shapes) {
    if (group.opacity != 1 || group.blend != scene::BlendMode::Normal || group.clip || group.mask ||
        group.filter)
        throw std::runtime_error("it is given paths alone, and no groups that are composited");
    for (const scene::Node& node : group.children) {
        if (const auto* inner = std::get_if<scene::Group>(&node.value)) {
            collect(*inner, shapes);
            continue;
        }
        const auto* item = std::get_if<scene::Item>(&node.value);
        const auto* color = item ? std::get_if<scene::Color>(&item->paint) : nullptr;
        if (!color)
            throw std::runtime_error("it is given colours alone, and neither gradients nor images");
        shapes.push_back({withoutArcs(*item->path), item->transform, item->geometry, *color});
        shapes.back().color.a *= item->opacity;
    }
}

}  // namespace

scene::Path withoutArcs(const scene::Path& path) {
    scene::Path result;
    scene::Point at(0), start(0);
    for (const scene::Command& command : path) {
        const auto* arc = std::get_if<scene::ArcTo>(&command);
        const auto center = arc ? scene::centerForm(at, *arc) : std::nullopt;
        if (center) {
            const int count = geometry::cubicCount(*center, std::numbers::pi / 2);
            for (const geometry::Cubic& cubic : geometry::cubics(*center, count))
                result.push_back(scene::CubicTo{cubic.p1, cubic.p2, cubic.p3});
        } else if (arc) {
            result.push_back(scene::LineTo{arc->to});
        } else {
            result.push_back(command);
        }
        at = scene::endOf(command).value_or(start);
        if (std::holds_alternative<scene::MoveTo>(command))
            start = at;
    }
    return result;
}

std::vector<Shape> shapesOf(const scene::Scene& scene) {
    std::vector<Shape> shapes;
    collect(scene.root, shapes);
    return shapes;
}

}  // namespace vtm::bench
