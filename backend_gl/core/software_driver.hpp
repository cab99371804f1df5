/// \file
/// Whether the driver's "GPU" is this machine's CPU: by its name, and where that tells nothing by the CPU
/// time that drawing takes.
#pragma once

#include <string_view>

#include <vtm/gl/renderer.hpp>

namespace vtm::gl {

/// CPU milliseconds of all threads of the process: of drawing a known amount of arithmetic, and of a share of
/// it on one core.
struct WorkTimes {
    double drawing = 0, share = 0;
};
/// Draws some, of as much as a software driver takes one to three milliseconds for. GL is in the state of
/// StateGuard. Throws GlError.
WorkTimes timeWork();
bool isCpuWork(const WorkTimes& times);

/// Of the current context, in the state of StateGuard, by the name that is given. Drivers whose name does not
/// tell are timed once in a process.
bool isSoftwareDriver(std::string_view renderer);
/// ... by GL_RENDERER.
bool isSoftwareDriver();

/// Whether the CPU computes what shaders could draw, too: it is asked to, or the driver's shaders run on it.
bool drawsOnCpu(Pixels pixels);

}  // namespace vtm::gl
