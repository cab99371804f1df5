/// \file
/// A picture made of formulas: balloons over a lake in the evening.
#pragma once

#include <cstdint>
#include <vector>

namespace lake {

/// Pixels 0xRRGGBBff, opaque, sRGB, rows from the BOTTOM, as vgImageSubData takes them in the format
/// VG_sRGBA_8888.
std::vector<std::uint32_t> picture(int width, int height);

}  // namespace lake
