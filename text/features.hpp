/// \file
/// What a font can do in shaping.
#pragma once

#include "text/font.hpp"

namespace vtm::text {

/// Whether any script or language of the font's table `GSUB` has the feature.
bool hasFeature(const Font& font, Tag feature);

}  // namespace vtm::text
