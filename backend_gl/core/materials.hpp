/// \file
/// User GLSL as a part of fragment shaders.
#pragma once

#include <span>
#include <string>

#include <vtm/asset/asset.hpp>

namespace vtm::gl {

/// Every material's text, and the function that chooses among them:
///     vec4 materialColor(uint material, vec2 p)
/// It comes last in a shader, so that a name that is taken is an error of the user's line. `#line` makes a
/// driver's log count lines from the beginning of each text, material i being source string `materialString`
/// + i.
std::string materialsSource(std::span<const asset::Material> materials);
inline constexpr int materialString = 30000;  // above any string or line of ours

/// A compiler's message that begins with the material and the line at fault, where its log names one:
/// "material 'wood', line 3: ...". Where it names none (Mesa does not for functions defined twice): with all
/// materials.
std::string blamedOnMaterial(std::span<const asset::Material> materials, const std::string& message);

}  // namespace vtm::gl
