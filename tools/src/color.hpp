/// \file
/// The ground that a picture is laid on.
#pragma once

#include <string>

#include <vtm/image/bitmap.hpp>
#include <vtm/scene/paint.hpp>

namespace vtm::tools {

/// Any colour that SVG knows. Throws UsageError.
scene::Color parseColor(const std::string& text);

/// Lays the picture over `ground`.
void layOver(image::Raster& picture, const scene::Color& ground);
void layOver(image::Bitmap& picture, const scene::Color& ground);

}  // namespace vtm::tools
