/// \file
/// What peers that draw by OpenGL ES draw into.
#pragma once

#include <GLES3/gl3.h>

#include <vtm/image/bitmap.hpp>

namespace vtm::bench {

/// A framebuffer of 8 bits a channel with a stencil, in the current context. Rows from the bottom up.
class GlFramebuffer {
public:
    /// Throws std::runtime_error where the driver refuses it.
    GlFramebuffer(int width, int height);
    ~GlFramebuffer();
    GlFramebuffer(const GlFramebuffer&) = delete;
    GlFramebuffer& operator=(const GlFramebuffer&) = delete;

    GLuint name() const { return framebuffer_; }
    int width() const { return width_; }
    int height() const { return height_; }

    /// For drawing, all of it.
    void bind() const;
    /// What was drawn, premultiplied there.
    image::Bitmap pixels() const;

private:
    int width_, height_;
    GLuint framebuffer_ = 0, renderbuffers_[2]{};  ///< colour, then depth and stencil
};

}  // namespace vtm::bench
