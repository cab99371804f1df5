/// \file
/// A windowless EGL context with OpenGL ES 3.0 or later.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

namespace vtm::gl {

/// What EGL or GL refused, with its error code.
class GlError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Made surfaceless: on a real GPU where EGL's device list has one, else on Mesa's software driver;
/// EGL_PLATFORM and LIBGL_ALWAYS_SOFTWARE are respected. Current on the thread that made it.
class Context {
public:
    Context();
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    const std::string& renderer() const;  ///< GL_RENDERER
    const std::string& version() const;   ///< GL_VERSION

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vtm::gl
