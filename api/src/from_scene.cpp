// Painter's order as selections: T_i = select(mask_i, over(paint_i, T_{i-1}), T_{i-1}).

#include <map>

#include <vtm/authoring.hpp>
#include "scene/level.hpp"

namespace vtm {

namespace {

class Folder {
public:
    Vtm fold(const scene::Group& group) {
        return Vtm::layer(children(group), {}, {group.opacity, group.blend, group.clip, group.mask});
    }

private:
    Vtm children(const scene::Group& group) {
        const scene::Level level(depth_);
        Vtm below;
        for (const scene::Node& node : group.children)
            below = std::visit([&](const auto& value) { return lay(value, std::move(below)); }, node.value);
        return below;
    }

    static Vtm lay(const scene::Item& item, Vtm below) {
        const Vtm paint = Vtm::paint(item.paint, item.opacity).placed(item.transform);
        return Vtm::select({item.path, item.transform, item.geometry}, Vtm::over(paint, below), below);
    }

    Vtm lay(const scene::Group& group, Vtm below) {
        return Vtm::layer(children(group), std::move(below),
                          {group.opacity, group.blend, group.clip, group.mask});
    }

    Vtm lay(const scene::Select& select, Vtm below) {
        return Vtm::over(Vtm::select(select.mask, side(select.inside), side(select.outside)),
                         std::move(below));
    }

    /// Shared sides stay shared.
    Vtm side(const std::shared_ptr<const scene::Group>& group) {
        if (!group)
            return {};
        const auto known = sides_.find(group.get());
        return known != sides_.end() ? known->second : sides_[group.get()] = fold(*group);
    }

    std::map<const scene::Group*, Vtm> sides_;
    int depth_ = 0;
};

}  // namespace

Vtm Vtm::fromScene(const scene::Scene& scene) { return Folder().fold(scene.root); }

}  // namespace vtm
