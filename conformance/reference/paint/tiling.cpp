#include "conformance/reference/paint/tiling.hpp"

#include <array>

#include <glm/common.hpp>

#include <vtm/scene/scene.hpp>

namespace vtm::reference {
namespace {

Box mapped(const Affine& m, const Box& box) {
    return Box::around(std::array{scene::apply(m, box.min), scene::apply(m, {box.max.x, box.min.y}),
                                  scene::apply(m, {box.min.x, box.max.y}), scene::apply(m, box.max)});
}

}  // namespace

std::optional<std::vector<Affine>> tilesMeeting(const Box& region, const scene::Pattern& pattern,
                                                const Affine& patternToPixels, double limit) {
    const auto toPattern = scene::inverse(patternToPixels);
    if (!toPattern)
        return std::nullopt;
    const Vector size = pattern.max - pattern.min;
    const Box covered = mapped(*toPattern, region);
    const Vector first = glm::floor((covered.min - pattern.min) / size);
    const Vector last = glm::floor((covered.max - pattern.min) / size);
    if (!((last.x - first.x + 1) * (last.y - first.y + 1) <= limit))
        return std::nullopt;
    std::vector<Affine> tiles;
    for (double j = first.y; j <= last.y; ++j) {
        for (double i = first.x; i <= last.x; ++i) {
            const Affine tile = scene::compose(patternToPixels, scene::translation(i * size.x, j * size.y));
            if (mapped(tile, {pattern.min, pattern.max}).meets(region))
                tiles.push_back(tile);
        }
    }
    return tiles;
}

std::size_t itemCount(const scene::Group& group) {
    const auto side = [](const auto& part) { return part ? itemCount(*part) : 0; };
    std::size_t count = 1;
    for (const scene::Node& node : group.children) {
        if (const auto* child = std::get_if<scene::Group>(&node.value))
            count += itemCount(*child);
        else if (const auto* select = std::get_if<scene::Select>(&node.value))
            count += 1 + side(select->inside) + side(select->outside);
        else
            ++count;
    }
    return count;
}

}  // namespace vtm::reference
