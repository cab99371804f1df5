/// \file
/// What a driver's GL_RENDERER tells.
#pragma once

#include <optional>
#include <string_view>

namespace vtm::gles_context {

/// Whether shaders run on the CPU; nothing where the name does not tell.
std::optional<bool> isSoftwareName(std::string_view renderer);

}  // namespace vtm::gles_context
