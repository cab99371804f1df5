#include "backend_gl/output/target.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace vtm::gl {

namespace {

bool holdsIntegers(GLenum format) { return format == GL_RGBA16UI; }

Target makeTarget(GLenum format, glm::ivec2 size) {
    Target target;
    target.format = format;
    target.size = size;
    target.texture = makeTexture(format, size.x, size.y);
    target.framebuffer = makeFramebuffer();
    target.bind();
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.texture.get(), 0);
    const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        throw GlError(
            fmt::format("framebuffer of {} x {} pixels is not complete (0x{:04x})", size.x, size.y, status));
    if (!holdsIntegers(format))
        clear(target, {{0, 0}, size});
    checkErrors("target");
    return target;
}

}  // namespace

std::optional<GLenum> floatFormat() {
    if (hasExtension("GL_EXT_color_buffer_float"))
        return hasExtension("GL_EXT_float_blend") ? GL_RGBA32F : GL_RGBA16F;
    if (hasExtension("GL_EXT_color_buffer_half_float"))
        return GL_RGBA16F;
    return std::nullopt;
}

Target TargetPool::take(glm::ivec2 size, GLenum format) {
    if (format == 0) {
        if (!floatFormat_)
            floatFormat_ = floatFormat();
        if (!floatFormat_)
            throw GlError("the driver cannot draw into float textures (no GL_EXT_color_buffer_float)");
        format = *floatFormat_;
    }
    const auto found = std::ranges::find_if(
        free_, [&](const Free& f) { return f.target.size == size && f.target.format == format; });
    if (found == free_.end())
        return makeTarget(format, size);
    Target target = std::move(found->target);
    free_.erase(found);
    return target;
}

void TargetPool::giveBack(Target&& target) {
    gl::clear(target, target.touched);
    target.touched = {};
    free_.push_back({std::move(target)});
}

void TargetPool::dropUnused() {
    std::erase_if(free_, [](const Free& f) { return !f.isUsed; });
    for (Free& f : free_)
        f.isUsed = false;
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
