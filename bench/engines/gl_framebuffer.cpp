#include "bench/engines/gl_framebuffer.hpp"

#include <stdexcept>
#include <vector>

namespace vtm::bench {

GlFramebuffer::GlFramebuffer(int width, int height) : width_(width), height_(height) {
    glGenFramebuffers(1, &framebuffer_);
    glGenRenderbuffers(2, renderbuffers_);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    const GLenum formats[]{GL_RGBA8, GL_DEPTH24_STENCIL8};
    const GLenum attachments[]{GL_COLOR_ATTACHMENT0, GL_DEPTH_STENCIL_ATTACHMENT};
    for (int i = 0; i < 2; ++i) {
        glBindRenderbuffer(GL_RENDERBUFFER, renderbuffers_[i]);
        glRenderbufferStorage(GL_RENDERBUFFER, formats[i], width, height);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachments[i], GL_RENDERBUFFER, renderbuffers_[i]);
    }
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw std::runtime_error("OpenGL ES refuses a framebuffer of this size");
}

GlFramebuffer::~GlFramebuffer() {
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteRenderbuffers(2, renderbuffers_);
}

void GlFramebuffer::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glViewport(0, 0, width_, height_);
}

image::Bitmap GlFramebuffer::pixels() const {
    std::vector<unsigned char> bytes(4 * std::size_t(width_) * std::size_t(height_));
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
    image::Raster raster(width_, height_);
    const unsigned char* byte = bytes.data();
    for (int y = height_; y-- > 0;)
        for (int x = 0; x < width_; ++x)
            for (int channel = 0; channel < 4; ++channel)
                raster.pixel(x, y)[channel] = float(*byte++) / 255;
    return image::toBitmap(raster);
}

}  // namespace vtm::bench
