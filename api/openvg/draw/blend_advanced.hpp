/// \file
/// VG_KHR_advanced_blending.
#pragma once

#include "api/openvg/draw/blend.hpp"

namespace vtm::openvg {

/// Of a VGBlendModeKHR; null if it is none.
Blend advancedBlendOf(VGint mode);

}  // namespace vtm::openvg
