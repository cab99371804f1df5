/// \file
/// What a context must be for us, and whether it still is.
#pragma once

#include <functional>

#include "backend_gl/core/gl.hpp"

namespace vtm::gl {

/// Throws GlError unless the current context is OpenGL ES 3.0 or later with limits that suffice.
void requireContext();
/// No more than that there is one. Leaves GL's errors pending.
void requireCurrentContext();

/// The current context's glGetGraphicsResetStatus, where it has one and was made to give notice; else
/// nothing.
std::function<unsigned()> driversResetStatus();

}  // namespace vtm::gl
