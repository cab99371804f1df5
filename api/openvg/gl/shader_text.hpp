/// \file
/// The files of api/openvg/shaders as strings; the build writes the definitions.
#pragma once

#include <string_view>

namespace vtm::openvg::gl::shaders {

extern const std::string_view layer_prelude, cover_vertex, spaces, blend_modes, tiling, texel_field,
    gradient_field, surface_pixel, layer_fragment, store_fragment, copy_fragment, filter_fragment;

}  // namespace vtm::openvg::gl::shaders
