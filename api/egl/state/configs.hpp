/// \file
/// The configs that OpenVG adds to the system's (EGL specification section 3.4).
#pragma once

#include <vector>

#include <EGL/egl.h>

#include "api/egl/state/objects.hpp"

namespace vtm::egl {

inline constexpr EGLint maskBits = 8, maxSide = 16384, maxPixels = maxSide * maxSide;

/// Of a display whose system, if it has one, runs; with its lock held.
void makeConfigs(Display& display);

/// All that the system has; none where it does not run.
std::vector<EGLConfig> systemConfigs(const Display& display);

/// An attribute of a config of the system's; 0 if it cannot be had. They never count as OpenVG's: even where
/// the system knows OpenVG, its contexts are not those that libOpenVG draws with.
EGLint systemConfigAttribute(const Display& display, EGLConfig config, EGLint name);

}  // namespace vtm::egl
