/// \file
/// The numbers that C++ and the shaders share.
#pragma once

#include <string>

namespace vtm::gl {

/// Texels a row of the asset's texture, pixels a row of the pictures' one, as powers of two. GLES 3.0
/// guarantees textures of 2048 only, but every driver known for it gives 4096.
inline constexpr unsigned texelColumnsLog2 = 12, imageColumnsLog2 = 12;
/// Texels a row of the placements' texture: four a map.
inline constexpr unsigned placementColumns = 1024;

/// What layer_fragment.glsl does to its target.
enum class Action : unsigned {
    Clip,  ///< target · coverage
    Mask,  ///< target · what the popped picture leaves as a mask
    Over   ///< popped picture · opacity, blended over
};

/// What blur_fragment.glsl does along an axis.
enum class BlurAction : unsigned {
    Reduce,  ///< to means over coarse pixels
    Kernel,
    Enlarge  ///< coarse pixels back to pixels
};

/// Declarations that follow prelude.glsl in every shader, made from asset.hpp's and these.
std::string glslConstants();
/// Those that only filters need.
std::string filterConstants();

}  // namespace vtm::gl
