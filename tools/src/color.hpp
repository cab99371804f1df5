/// \file
/// The ground that a picture is laid on.
#pragma once

#include <string>

#include <vtm/image/bitmap.hpp>
#include <vtm/scene/paint.hpp>

namespace vtm::tools {

/// Any colour that SVG knows. Throws UsageError.
scene::Color parseColor(const std::string& text);

/// For files that have no alpha.
scene::Color overWhite(const scene::Color& color);

}  // namespace vtm::tools
