/// \file
/// A windowless EGL context with OpenGL ES 3.0 or later, and the errors of contexts.
#pragma once

#include <memory>
#include <string>

#include <vtm/error.hpp>

#pragma GCC visibility push(default)

namespace vtm::gl {

/// EGL or GL rejected a call. The message has its error code.
class GlError : public Error {
    using Error::Error;
};

/// GL_OUT_OF_MEMORY. The requested object was not made; the renderer remains usable.
class OutOfMemory : public GlError {
    using GlError::GlError;
};

/// The context was reset and all its objects are lost: make a new context and a new renderer, and upload
/// again.
class ContextLost : public GlError {
    using GlError::GlError;
};

/// The kind of driver that EGL offers.
enum class Driver {
    None,       ///< no device: no Context can be made
    Software,   ///< shaders run on the CPU
    PerhapsGpu  ///< only a context can tell
};

/// Reads EGL's list of devices, which takes 1 to 2 ms; making a context takes about 50 ms with Mesa's
/// software driver. Respects LIBGL_ALWAYS_SOFTWARE.
Driver likelyDriver();

class Context;

struct ContextOptions {
    /// A context to share objects with, on the same display; null: none.
    const Context* share = nullptr;
    /// Asks the driver to report resets if it can (GL_KHR_robustness, GL_EXT_robustness).
    bool robust = true;
};

/// A surfaceless context: on a GPU if EGL's device list has one, else on Mesa's software driver. Respects
/// EGL_PLATFORM and LIBGL_ALWAYS_SOFTWARE. It is current on the thread that made it.
class Context {
public:
    explicit Context(const ContextOptions& options = {});
    /// If this context was current, none is current afterwards.
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    /// Makes the context current on this thread. Throws GlError.
    void makeCurrent() const;

    const std::string& renderer() const;  ///< GL_RENDERER
    const std::string& version() const;   ///< GL_VERSION
    bool isSoftware() const;              ///< shaders run on the CPU, as far as GL_RENDERER is known

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vtm::gl

#pragma GCC visibility pop
