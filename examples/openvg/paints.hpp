/// \file
/// Paints of OpenVG in a line each. Colours are 0xRRGGBBAA, straight, sRGB. Whoever calls owns the paint.
#pragma once

#include <vector>

#include <VG/openvg.h>

namespace paints {

/// One stop of a colour ramp: an offset in [0, 1], in rising order, and its colour.
struct Stop {
    VGfloat offset;
    VGuint rgba;
};
using Ramp = std::vector<Stop>;

VGPaint solid(VGuint rgba);
/// From (x0, y0) to (x1, y1).
VGPaint linear(VGfloat x0, VGfloat y0, VGfloat x1, VGfloat y1, const Ramp& ramp);
/// From the focus (fx, fy) to the circle about (cx, cy).
VGPaint radial(VGfloat cx, VGfloat cy, VGfloat fx, VGfloat fy, VGfloat radius, const Ramp& ramp);

/// Draws with a paint that is used but once.
void fillOnce(VGPath path, VGPaint paint);
void strokeOnce(VGPath path, VGPaint paint, VGfloat width);

}  // namespace paints
