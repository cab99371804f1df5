// Between scenes and authoring trees.

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <string>

#include <vtm/authoring.hpp>
#include <vtm/scene/scene.hpp>
#include "api/src/scene_conversion.hpp"
#include "scene/place.hpp"

namespace vtm {

namespace {

using scene::Affine;
using scene::compose;

class Folder {
public:
    Vtm fold(const scene::Group& group) {
        return Vtm::layer(children(group), {},
                          {group.opacity, group.blend, group.clip, group.mask, group.filter});
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
                          {group.opacity, group.blend, group.clip, group.mask, group.filter});
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

Vtm fromGroup(const scene::Group& group) { return Folder().fold(group); }

Vtm Vtm::fromScene(const scene::Scene& scene) { return fromGroup(scene.root); }

// Author's tree to normal form. The rule that keeps it small: a layer that shows in a mask alone may be taken
// out of a selection whose sides share all else,
//
//     select(m, layer(X, T), T) = layer(select(m, X, nothing), T),
//
// since outside the mask both are T and inside both are X on T. Without it, a chain of n layers made by
// fromScene, which names T twice in every step, would take 2^n items.

namespace {

using Nodes = std::vector<scene::Node>;

bool blends(const scene::Node& node) {
    const auto* group = std::get_if<scene::Group>(&node.value);
    return group && group->blend != scene::BlendMode::Normal;
}

void moveTransform(scene::Paint& paint, const Affine& by) {
    std::visit(
        [&](auto& value) {
            if constexpr (requires { value.transform; })
                value.transform = compose(by, value.transform);
        },
        paint);
}

/// A node behind the places that were put around it.
struct Found {
    const VtmNode* node;
    Affine at;
};

Found found(const Vtm& vtm, Affine at) {
    const VtmNode* node = vtm.node();
    while (node != nullptr) {
        const auto* placed = std::get_if<PlacedNode>(&node->value);
        if (placed == nullptr)
            break;
        at = compose(at, placed->transform);
        node = placed->content.node();
    }
    return {node, at};
}

class Unfolder {
public:
    Unfolder(scene::Point min, scene::Point max)
        : frame_(std::make_shared<const scene::Path>(scene::rectangle(min, max))) {}

    /// As one group.
    scene::Group group(const Vtm& vtm, const Affine& at) {
        Nodes content = nodes(vtm, at);
        if (auto* only = content.size() == 1 ? std::get_if<scene::Group>(&content[0].value) : nullptr;
            only && only->blend == scene::BlendMode::Normal)
            return std::move(*only);
        scene::Group result;
        result.children = std::move(content);
        return result;
    }

    /// Whether an item has the frame for its path.
    bool fillsFrame() const { return frame_.use_count() > 1; }

private:
    /// In painter's order. Goes down a chain from the top without recursion.
    Nodes nodes(const Vtm& vtm, const Affine& at) {
        const scene::Level level(depth_);
        std::vector<Nodes> fromTop;
        for (Found next = found(vtm, at); next.node != nullptr;) {
            limits::check();
            const auto [node, place] = next;
            next = {nullptr, place};
            if (const auto* paint = as<PaintNode>(node)) {
                fromTop.push_back({{paintEverywhere(*paint, place)}});
            } else if (const auto* layer = as<LayerNode>(node)) {
                fromTop.push_back(composited(nodes(layer->top, place), layer->how, place));
                next = found(layer->below, place);
            } else {
                const auto& select = std::get<SelectNode>(node->value);
                const auto* inside = as<LayerNode>(select.inside.node());
                // What a filter makes of a part is not that part of what it makes of the whole.
                if (inside && !inside->how.filter && inside->below == select.outside) {
                    fromTop.push_back(composited(cut(select.mask, inside->top, place), inside->how, place));
                    next = found(inside->below, place);
                } else if (!select.outside.node()) {
                    fromTop.push_back(cut(select.mask, select.inside, place));
                } else {
                    fromTop.push_back({{chosen(select.mask, select.inside, select.outside, place)}});
                }
            }
        }
        Nodes all;
        for (auto part = fromTop.rbegin(); part != fromTop.rend(); ++part)
            std::move(part->begin(), part->end(), std::back_inserter(all));
        return all;
    }

    /// A layer's content on what is below; plain layers give way to theirs unless it would blend with that.
    static Nodes composited(Nodes content, const Compositing& how, const Affine& at) {
        if (how.isPlain() && std::none_of(content.begin(), content.end(), blends))
            return content;
        scene::Group group{std::move(content),   how.opacity,          how.blend,
                           placed(how.clip, at), placed(how.mask, at), placed(how.filter, at)};
        return {{std::move(group)}};
    }

    scene::Item paintEverywhere(const PaintNode& paint, const Affine& at) const {
        scene::Item item{frame_, scene::identity, scene::FillRule::NonZero, paint.paint, paint.opacity};
        moveTransform(item.paint, at);
        return item;
    }

    /// select(mask, content, nothing): an item if the content is a paint.
    Nodes cut(const Mask& mask, const Vtm& content, const Affine& at) {
        const Found inner = found(content, scene::identity);
        const auto* paint = as<PaintNode>(inner.node);
        if (paint == nullptr)
            return {{chosen(mask, content, {}, at)}};
        scene::Item item{mask.path, compose(at, mask.transform), mask.geometry, paint->paint, paint->opacity};
        if (inner.at != mask.transform) {
            const auto toPath = scene::inverse(mask.transform);
            if (!toPath)
                return {};  // a flat mask has no inside
            moveTransform(item.paint, compose(*toPath, inner.at));
        }
        return {{std::move(item)}};
    }

    scene::Select chosen(const Mask& mask, const Vtm& inside, const Vtm& outside, const Affine& at) {
        return {{mask.path, compose(at, mask.transform), mask.geometry}, side(inside, at), side(outside, at)};
    }

    /// A part that stands in the tree twice, at one place, stays one part.
    std::shared_ptr<const scene::Group> side(const Vtm& vtm, const Affine& at) {
        if (vtm.node() == nullptr)
            return nullptr;
        const Key key{vtm.node(), {at[0].x, at[0].y, at[1].x, at[1].y, at[2].x, at[2].y}};
        const auto known = sides_.find(key);
        return known != sides_.end() ? known->second
                                     : sides_[key] = std::make_shared<const scene::Group>(group(vtm, at));
    }

    using Key = std::pair<const VtmNode*, std::array<double, 6>>;

    std::shared_ptr<const scene::Path> frame_;
    std::map<Key, std::shared_ptr<const scene::Group>> sides_;
    int depth_ = 0;
};

}  // namespace

FramedGroup toGroup(const Vtm& vtm, scene::Point min, scene::Point max) {
    Unfolder unfolder(min, max);
    scene::Group group = unfolder.group(vtm, scene::identity);
    return {std::move(group), unfolder.fillsFrame()};
}

scene::Scene Vtm::toScene(double width, double height) const {
    return {width, height, toGroup(*this, {0, 0}, {width, height}).group};
}

}  // namespace vtm
