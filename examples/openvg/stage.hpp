/// \file
/// Where the examples of OpenVG draw: in memory, kept as a PNG file, or in a window.
///
/// Nothing below this file differs between the two. In memory a context comes from <vtm/vg.h>, in a window
/// from EGL, as in any program of EGL and OpenVG.
#pragma once

#include <functional>
#include <memory>
#include <string>

namespace stage {

/// Has an OpenVG context and a drawing surface, current in this thread until it is destroyed.
class Stage {
public:
    virtual ~Stage() = default;

    /// Calls frame(seconds): once, with `seconds`, for a file; from `seconds` on, again and again, until a
    /// window is closed. Throws std::runtime_error if OpenVG reports an error or the file cannot be written.
    virtual void show(double seconds, const std::function<void(double)>& frame) = 0;
};

/// `target`: the PNG file to write, or "window". Throws std::runtime_error if there is no window to be had.
std::unique_ptr<Stage> open(const std::string& target, int width, int height, const std::string& title);

/// A window of X11, by EGL (window.cpp).
std::unique_ptr<Stage> openWindow(int width, int height, const std::string& title);

/// Throws std::runtime_error with the error's name if there was one since the last call.
void checkErrors();

/// main() of an example: prints what was thrown. Returns an exit code.
int run(const std::function<void()>& program);

}  // namespace stage
