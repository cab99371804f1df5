#include "compiler/direct/stack_tree.hpp"

#include <bit>
#include <utility>

#include "compiler/direct/layer_cover.hpp"

namespace vtm::compiler {

StackTree::StackTree(const LoweredScene& picture, std::vector<glm::vec4> colors,
                     std::span<const std::uint32_t> groups, std::span<const std::uint32_t> around)
    : picture_(picture), colors_(std::move(colors)), blocks_(colors_.size()) {
    const auto groupRound = [&](std::uint32_t group) {
        const std::uint32_t parent = picture.groups[group].parent;
        return parent == noIndex ? noIndex : around[parent];
    };
    std::vector<OpenGroup> open{{noIndex, {}}};
    std::vector<std::uint32_t> path;
    for (std::uint32_t layer = 0; layer < colors_.size(); ++layer) {
        path.clear();
        for (std::uint32_t g = groups[layer]; g != noIndex; g = groupRound(g))
            path.push_back(g);
        std::size_t common = 1;
        while (common < open.size() && common <= path.size() &&
               open[common].group == path[path.size() - common])
            ++common;
        while (open.size() > common)
            close(open);
        while (open.size() <= path.size())
            open.push_back({path[path.size() - open.size()], {}});
        addLayer(open.back(), layer);
    }
    while (open.size() > 1)
        close(open);
    root_ = joined(open[0].nodes);
}

void StackTree::addLayer(OpenGroup& group, std::uint32_t layer) {
    const bool goesOn = !group.nodes.empty() && nodes_[group.nodes.back()].end == layer &&
                        layer % blockLayers != 0 && !nodes_[group.nodes.back()].isGroup;
    if (!goesOn) {
        group.nodes.push_back(std::uint32_t(nodes_.size()));
        nodes_.push_back({.first = layer});
    }
    nodes_[group.nodes.back()].end = layer + 1;
    blocks_[layer] = group.nodes.back();
}

std::uint32_t StackTree::joined(std::span<const std::uint32_t> nodes) {
    if (nodes.size() == 1)
        return nodes[0];
    const std::uint32_t lower = joined(nodes.first(nodes.size() / 2)),
                        upper = joined(nodes.subspan(nodes.size() / 2));
    const auto pair = std::uint32_t(nodes_.size());
    nodes_[lower].parent = nodes_[upper].parent = pair;
    nodes_.push_back(
        {.first = nodes_[lower].first, .end = nodes_[upper].end, .upper = upper, .lower = lower});
    return pair;
}

/// The innermost group becomes a node of the one round it.
void StackTree::close(std::vector<OpenGroup>& open) {
    const std::uint32_t node = joined(open.back().nodes);
    nodes_[node].opacity *= picture_.groups[open.back().group].opacity;
    nodes_[node].isGroup = true;
    open.pop_back();
    open.back().nodes.push_back(node);
}

StackColor StackTree::color(std::span<const std::uint64_t> inside) {
    inside_ = inside;
    Way way;
    goDown(root_, way);
    return {std::bit_cast<glm::vec4>(way.color), way.light > unseen ? 0 : way.hidden};
}

/// Calls visit(layer), which tells whether to go on, for the layers of a block that are there.
template <class Visit>
void StackTree::forEachFromTop(const Node& block, const Visit& visit) const {
    const std::uint32_t shift = block.first % 64, count = block.end - block.first;
    std::uint64_t bits = inside_[block.first / 64] >> shift & ((std::uint64_t{1} << count) - 1);
    while (bits != 0) {
        const auto bit = std::uint32_t(std::bit_width(bits) - 1);
        bits ^= std::uint64_t{1} << bit;
        if (!visit(block.first + bit))
            return;
    }
}

/// What lies below layers that let no light through stays as it was: nobody asks for it.
void StackTree::refresh(std::uint32_t number) {
    Node& node = nodes_[number];
    if (!node.isStale)
        return;
    node.isStale = false;
    Float4 color{};
    float light = 1;
    const auto add = [&](Float4 below) {
        color += light * below;
        light *= 1 - below[3];
        return light > unseen;
    };
    if (node.upper == noIndex) {
        forEachFromTop(node, [&](std::uint32_t layer) { return add(std::bit_cast<Float4>(colors_[layer])); });
    } else {
        refresh(node.upper);
        if (add(nodes_[node.upper].color)) {
            refresh(node.lower);
            add(nodes_[node.lower].color);
        }
    }
    node.color = node.opacity * color;
}

/// Whole nodes are added, but for that in which the light ends.
void StackTree::goDown(std::uint32_t number, Way& way) {
    refresh(number);
    const Node& node = nodes_[number];
    const float light = way.light * (1 - node.color[3]);
    if (light > unseen || node.isGroup) {
        way.color += way.light * node.color;
        way.light = light;
        way.hidden = node.first;
    } else if (node.upper == noIndex) {
        forEachFromTop(node, [&](std::uint32_t layer) {
            const auto color = std::bit_cast<Float4>(colors_[layer]);
            way.color += way.light * color;
            way.light *= 1 - color[3];
            way.hidden = layer;
            return way.light > unseen;
        });
    } else {
        goDown(node.upper, way);
        if (way.light > unseen)
            goDown(node.lower, way);
    }
}

}  // namespace vtm::compiler
