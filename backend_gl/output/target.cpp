#include "backend_gl/output/target.hpp"

#include <fmt/format.h>

namespace vtm::gl {

namespace {

Target makeTarget(GLenum format, glm::ivec2 size) {
    Target target;
    target.texture = makeTexture(format, size.x, size.y);
    target.framebuffer = makeFramebuffer();
    target.bind();
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.texture.get(), 0);
    const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        throw GlError(
            fmt::format("framebuffer of {} x {} pixels is not complete (0x{:04x})", size.x, size.y, status));
    clear(target, {{0, 0}, size});
    checkErrors("target");
    return target;
}

}  // namespace

GLenum targetFormat() {
    if (!hasExtension("GL_EXT_color_buffer_float")) {
        if (!hasExtension("GL_EXT_color_buffer_half_float"))
            throw GlError("the driver cannot draw into float textures (no GL_EXT_color_buffer_float)");
        return GL_RGBA16F;
    }
    return hasExtension("GL_EXT_float_blend") ? GL_RGBA32F : GL_RGBA16F;
}

void TargetPool::resize(glm::ivec2 size) {
    if (size == size_)
        return;
    free_.clear();
    size_ = size;
}

Target TargetPool::take() {
    if (free_.empty())
        return makeTarget(format_ == 0 ? targetFormat() : format_, size_);
    Target target = std::move(free_.back());
    free_.pop_back();
    return target;
}

void TargetPool::giveBack(Target&& target) {
    clear(target, target.touched);
    target.touched = {};
    free_.push_back(std::move(target));
}

void clear(const Target& target, const PixelBox& box) {
    if (box.empty())
        return;
    target.bind();
    glEnable(GL_SCISSOR_TEST);
    glScissor(box.min.x, box.min.y, box.size().x, box.size().y);
    const GLfloat transparent[4] = {0, 0, 0, 0};
    glClearBufferfv(GL_COLOR, 0, transparent);
    glDisable(GL_SCISSOR_TEST);
}

}  // namespace vtm::gl
