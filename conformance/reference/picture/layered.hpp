/// \file
/// Scenes with filters, as layers: what has no filter in it stays together and is drawn as any picture;
/// filtered groups lie over it and under it, pixel by pixel (docs/filters.md).
#pragma once

#include <functional>

#include <vtm/scene/scene.hpp>
#include "conformance/reference/filter/pixels.hpp"

namespace vtm::reference {

bool hasFilters(const scene::Group& group);

/// Draws nodes without filters on the pixels of `place`.
using DrawPlain =
    std::function<Pixels(const scene::NodeList& nodes, const scene::Affine& toPixels, const Pixels& place)>;

/// The scene's root on the pixels of `place`, cut to the scene's rectangle.
Pixels drawLayered(const scene::Scene& scene, const scene::Affine& toPixels, const Pixels& place,
                   bool wholePixels, const DrawPlain& draw);

}  // namespace vtm::reference
