/// \file
/// Where an element stands: its computed style, its user space and its viewport.
#pragma once

#include <vtm/scene/affine.hpp>
#include "svg/css/style.hpp"

namespace vtm::svg {

struct ContextElement;

/// Where an element stands.
struct Scope {
    Style style;
    scene::Affine transform = scene::identity;  ///< user space to picture
    Viewport viewport;
    const ContextElement* context = nullptr;  ///< what context-fill and context-stroke refer to
    int depth = 0;                            ///< elements around it, `use` expanded
};

}  // namespace vtm::svg
