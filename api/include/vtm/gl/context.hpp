/// \file
/// A windowless EGL context with OpenGL ES 3.0 or later, and the errors of contexts.
#pragma once

#include <memory>
#include <string>

#include <vtm/error.hpp>

#pragma GCC visibility push(default)

namespace vtm::gl {

/// What EGL or GL refused, with its error code.
class GlError : public Error {
    using Error::Error;
};

/// GL_OUT_OF_MEMORY. What was asked for is not there; the renderer goes on working.
class OutOfMemory : public GlError {
    using GlError::GlError;
};

/// The context was reset, and all that was in it is gone: make a new one, a new renderer, and upload again.
class ContextLost : public GlError {
    using GlError::GlError;
};

/// What EGL has to offer.
enum class Driver {
    None,       ///< no device: every Context would fail
    Software,   ///< shaders run on the CPU
    PerhapsGpu  ///< a context will tell
};

/// From EGL's list of devices, in a millisecond or two and without a context, which takes Mesa's software
/// driver some fifty. LIBGL_ALWAYS_SOFTWARE is respected.
Driver likelyDriver();

class Context;

struct ContextOptions {
    /// Shares its objects, on its display.
    const Context* share = nullptr;
    /// Asks for notice of resets, where the driver can give it (GL_KHR_robustness, GL_EXT_robustness).
    bool robust = true;
};

/// Made surfaceless: on a real GPU where EGL's device list has one, else on Mesa's software driver;
/// EGL_PLATFORM and LIBGL_ALWAYS_SOFTWARE are respected. Current on the thread that made it.
class Context {
public:
    explicit Context(const ContextOptions& options = {});
    /// No context is current afterwards, if this one was.
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    /// On this thread. Throws GlError.
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
