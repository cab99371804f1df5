/// \file
/// Bold faces made from regular ones. Source: CSS Fonts 4 section 6.
#pragma once

#include <vtm/scene/path.hpp>

namespace vtm::text {

/// The outline grown by half of `strength` on every side; commands stay what they are. Outlines that
/// FreeType cannot hold, of more than 32767 points, stay as they are.
scene::Path emboldened(scene::Path path, double strength);

}  // namespace vtm::text
