/// \file
/// GLSL that can stand beside anybody's.
#pragma once

#include <string>
#include <string_view>

namespace vtm::gl {

/// The same text with `vtm_` before the name of every function, structure and constant that it declares, and
/// `VTM_` before every macro that it defines; names that begin so already stay. Comments and blank lines go,
/// and so do constants that are used nowhere. Members of structures keep their names, so these must be
/// others.
std::string prefixed(std::string_view glsl);

}  // namespace vtm::gl
