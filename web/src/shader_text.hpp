/// \file
/// The files of web/shaders, which the build embeds.
#pragma once

#include <string_view>

namespace vtm::web::shaders {

extern const std::string_view view_vertex, view_fragment, outline_vertex, outline_fragment;

}  // namespace vtm::web::shaders
