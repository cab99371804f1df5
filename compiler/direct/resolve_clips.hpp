/// \file
/// Clips whose outlines do not come near what they clip.
#pragma once

#include "compiler/lower/lowered_scene.hpp"

namespace vtm::compiler {

/// Takes clips away that let through all of what is in their groups, and the outlines of items of which they
/// let through nothing.
void resolveClips(LoweredScene& picture);

}  // namespace vtm::compiler
