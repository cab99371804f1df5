/// \file
/// Linear and radial gradients (specification section 9.3).
#pragma once

#include "api/openvg/draw/pixel_source.hpp"

namespace vtm::openvg {

/// Of a gradient paint; `fromSurface` leads to the paint's coordinates.
std::unique_ptr<PixelSource> gradientSource(const Paint& paint, const glm::dmat3& fromSurface);

}  // namespace vtm::openvg
