/// \file
/// The walk over those layers of a tree that count at a place, with their groups around them.
#pragma once

#include <span>

#include "conformance/reference/picture/flat_scene.hpp"

namespace vtm::reference {

/// Opens groups down from `from`, an ancestor of `to` or `to` itself.
template <class Canvas>
void openGroups(const Tree& tree, int from, int to, Canvas& canvas) {
    if (from == to)
        return;
    openGroups(tree, from, tree.groups[std::size_t(to)].parent, canvas);
    canvas.open(tree.groups[std::size_t(to)]);
}

template <class Canvas>
void closeGroups(const Tree& tree, int from, int to, Canvas& canvas) {
    for (; from != to; from = tree.groups[std::size_t(from)].parent)
        canvas.close(tree.groups[std::size_t(from)]);
}

inline int commonAncestor(const Tree& tree, int a, int b) {
    const auto node = [&](int i) -> const GroupNode& { return tree.groups[std::size_t(i)]; };
    while (a != b)
        node(a).depth >= node(b).depth ? a = node(a).parent : b = node(b).parent;
    return a;
}

/// Calls canvas.open(group), canvas.draw(layer) and canvas.close(group) in painter's order, for the
/// layers with the given indices (ascending) and the groups that hold them. The root is among them.
template <class Canvas>
void composite(const Tree& tree, std::span<const int> layers, Canvas& canvas) {
    canvas.open(tree.groups[0]);
    int group = 0;
    for (const int i : layers) {
        const Layer& layer = tree.layers[std::size_t(i)];
        const int shared = commonAncestor(tree, group, layer.group);
        closeGroups(tree, group, shared, canvas);
        openGroups(tree, shared, layer.group, canvas);
        group = layer.group;
        canvas.draw(layer);
    }
    closeGroups(tree, group, 0, canvas);
    canvas.close(tree.groups[0]);
}

}  // namespace vtm::reference
