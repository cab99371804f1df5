/// \file
/// Colour spaces and their ways to XYZ with the white of D65. Source: CSS Color 4 sections 7 to 10.
#pragma once

#include <functional>
#include <string_view>

#include <glm/vec3.hpp>

namespace vtm::svg {

using Vec3 = glm::dvec3;

/// Components are as in the functions of CSS, with 1 for 100 % in hsl and hwb; hues in degrees.
struct ColorSpace {
    std::string_view name;
    std::function<Vec3(Vec3)> toXyz, fromXyz;
    int hue = -1;           ///< which component is a hue
    bool isCommon = false;  ///< one of those of color()
};

/// Null for unknown names.
const ColorSpace* findColorSpace(std::string_view name);

}  // namespace vtm::svg
