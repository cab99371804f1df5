/// \file
/// Composite modes of COLR version 1 as groups. Source: Compositing and Blending Level 1, section 9.
#pragma once

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_COLOR_H

#include <vtm/scene/scene.hpp>

namespace vtm::text {

/// `source` composited with `backdrop`, as nodes to be drawn over nothing. `everywhere` covers both.
scene::NodeList composited(FT_Composite_Mode mode, scene::NodeList source, scene::NodeList backdrop,
                           const scene::Item& everywhere);

}  // namespace vtm::text
