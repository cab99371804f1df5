/// \file
/// Pictures that are drawn into.
#pragma once

#include <vector>

#include "backend_gl/core/gl.hpp"
#include "backend_gl/core/placement.hpp"

namespace vtm::gl {

/// A float texture with a framebuffer around it. Transparent outside `touched`.
struct Target {
    TextureHandle texture;
    FramebufferHandle framebuffer;
    PixelBox touched;

    void bind() const { glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.get()); }
    void touch(const PixelBox& box) { touched = touched.joined(box); }
};

/// RGBA32F where it can be blended into, else RGBA16F (docs/coverage.md says what that costs).
GLenum targetFormat();

/// Transparent targets of one size, kept for reuse.
class TargetPool {
public:
    /// 0: targetFormat().
    explicit TargetPool(GLenum format = 0) : format_(format) {}

    /// Drops targets of another size.
    void resize(glm::ivec2 size);
    glm::ivec2 size() const { return size_; }
    Target take();
    /// Makes the target transparent again and keeps it.
    void giveBack(Target&& target);

private:
    GLenum format_;
    glm::ivec2 size_{0};
    std::vector<Target> free_;
};

/// Makes the pixels of a box transparent.
void clear(const Target& target, const PixelBox& box);

}  // namespace vtm::gl
