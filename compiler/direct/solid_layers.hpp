/// \file
/// The layers of a picture of colours, and the translucent groups that they lie in.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec4.hpp>

#include "compiler/lower/lowered_scene.hpp"

namespace vtm::compiler {

/// A group of several layers is composited by itself. One with a single layer is that layer, with its
/// opacity.
struct SolidLayers {
    struct Layer {
        glm::vec4 color{0};             ///< premultiplied; transparent: it is a clip's
        std::uint32_t group = noIndex;  ///< the innermost that is composited
        bool isEvenOdd = false;

        bool isInside(std::int32_t winding) const { return isEvenOdd ? (winding & 1) != 0 : winding != 0; }
    };
    struct Group {
        float opacity = 1;
        std::uint32_t outer = noIndex;  ///< the next one round it that is composited
    };

    SolidLayers() = default;
    /// Of colours that are laid over each other.
    explicit SolidLayers(const LoweredScene& picture);

    std::vector<Layer> layers;
    std::vector<Group> groups;
};

}  // namespace vtm::compiler
