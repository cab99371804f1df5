/// \file
/// Compositing of premultiplied colours (W3C Compositing and Blending Level 1).
#pragma once

#include <glm/vec4.hpp>

#include <vtm/scene/scene.hpp>

namespace vtm::reference {

/// Premultiplied, sRGB-encoded.
using Colour = glm::dvec4;

inline Colour over(const Colour& below, const Colour& above) { return above + below * (1 - above.a); }

/// The source blended with and laid over the backdrop.
Colour blend(scene::BlendMode mode, const Colour& backdrop, const Colour& source);

/// Luminance times alpha of a premultiplied colour, on sRGB bytes or on linear light.
double luminance(const Colour& colour, bool linear);

}  // namespace vtm::reference
