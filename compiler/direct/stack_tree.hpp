/// \file
/// The colour of a deep stack of layers, asked for again and again while few of them come and go.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec4.hpp>

#include "compiler/lower/lowered_scene.hpp"

namespace vtm::compiler {

/// What a stack of layers shows.
struct StackColor {
    glm::vec4 color{0};        ///< premultiplied
    std::uint32_t hidden = 0;  ///< layers below this one do not show
};

/// A tree of `over`: a node has the colour of some layers next to each other, composited. Groups are nodes of
/// their own. A layer that comes or goes makes the nodes above it stale.
class StackTree {
public:
    /// `colors`, by layer, of which there are some: premultiplied, with the layer's opacity; transparent if
    /// it shows nothing. `groups`, by layer: the innermost translucent one round it, or noIndex. `around`, by
    /// group: the innermost translucent one round it or itself.
    StackTree(const LoweredScene& picture, std::vector<glm::vec4> colors,
              std::span<const std::uint32_t> groups, std::span<const std::uint32_t> around);

    /// The layer comes or goes.
    void change(std::uint32_t layer) {
        for (std::uint32_t at = blocks_[layer]; at != noIndex && !nodes_[at].isStale; at = nodes_[at].parent)
            nodes_[at].isStale = true;
    }
    /// `inside`: a bit a layer, of those that are there.
    StackColor color(std::span<const std::uint64_t> inside);

private:
    using Float4 = float __attribute__((vector_size(16)));
    /// Layers of one group whose bits are in one word, or two other nodes.
    static constexpr std::uint32_t blockLayers = 16;

    struct Node {
        Float4 color{};
        float opacity = 1;
        std::uint32_t parent = noIndex;
        std::uint32_t first = 0, end = 0;                ///< layers
        std::uint32_t upper = noIndex, lower = noIndex;  ///< none in a block
        bool isStale = true;
        bool isGroup = false;
    };
    struct OpenGroup {
        std::uint32_t group;
        std::vector<std::uint32_t> nodes;  ///< in it, from the bottom
    };
    /// On the way down through the stack.
    struct Way {
        Float4 color{};
        float light = 1;  ///< what is left of what lies below
        std::uint32_t hidden = 0;
    };

    void addLayer(OpenGroup& group, std::uint32_t layer);
    std::uint32_t joined(std::span<const std::uint32_t> nodes);
    void close(std::vector<OpenGroup>& open);
    void refresh(std::uint32_t node);
    void goDown(std::uint32_t node, Way& way);
    template <class Visit>
    void forEachFromTop(const Node& block, const Visit& visit) const;

    const LoweredScene& picture_;
    const std::vector<glm::vec4> colors_;
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> blocks_;  ///< by layer
    std::uint32_t root_;
    std::span<const std::uint64_t> inside_;
};

}  // namespace vtm::compiler
