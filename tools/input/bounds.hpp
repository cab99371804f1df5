/// \file
/// Where a scene draws.
#pragma once

#include <optional>

#include <vtm/scene/fit.hpp>
#include <vtm/scene/scene.hpp>

namespace vtm::tools {

/// The least rectangle round all fills and strokes within the picture, with joins, caps and dashes as they
/// are drawn; clips and masks cut nothing off. Strokes within 1/65536 of the picture's longer side. Nothing
/// where nothing is drawn.
std::optional<scene::Rect> drawnBounds(const scene::Scene& scene);

}  // namespace vtm::tools
