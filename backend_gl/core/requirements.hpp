/// \file
/// What a context must be for us, and whether it still is.
#pragma once

#include <functional>
#include <string_view>

#include "backend_gl/core/gl.hpp"

namespace vtm::gl {

/// Throws GlError unless the current context is OpenGL ES 3.0 or later with limits that suffice.
void requireContext();
/// No more than that there is one. Leaves GL's errors pending.
void requireCurrentContext();

/// The current context's glGetGraphicsResetStatus, where it has one and was made to give notice; else
/// nothing.
std::function<unsigned()> driversResetStatus();

/// Whether the driver's "GPU" is this machine's CPU: of the current context, or by its GL_RENDERER.
bool isSoftwareDriver();
bool runsOnCpu(std::string_view renderer);

}  // namespace vtm::gl
