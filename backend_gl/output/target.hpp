/// \file
/// Pictures that are drawn into.
#pragma once

#include <optional>
#include <vector>

#include "backend_gl/core/gl.hpp"
#include "backend_gl/core/placement.hpp"

namespace vtm::gl {

/// A texture with a framebuffer around it. Transparent outside `touched`, unless it holds integers.
struct Target {
    TextureHandle texture;
    FramebufferHandle framebuffer;
    GLenum format = 0;
    glm::ivec2 size{0};
    PixelBox touched;

    void bind() const { glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.get()); }
    void touch(const PixelBox& box) { touched = touched.joined(box); }
};

/// RGBA32F where it can be blended into, else RGBA16F (docs/coverage.md says what that costs); nothing where
/// the driver cannot draw into float textures.
std::optional<GLenum> floatFormat();

/// Targets, kept for reuse.
class TargetPool {
public:
    /// Transparent; what integers it holds is undefined. Format 0: floatFormat(), without which GlError is
    /// thrown.
    Target take(glm::ivec2 size, GLenum format = 0);
    /// Makes the target transparent again and keeps it.
    void giveBack(Target&& target);
    /// Drops what nobody took since the last call.
    void dropUnused();
    void clear() { free_.clear(); }

private:
    struct Free {
        Target target;
        bool isUsed = true;
    };
    std::vector<Free> free_;
    std::optional<GLenum> floatFormat_;
};

/// Makes the pixels of a box transparent.
void clear(const Target& target, const PixelBox& box);

}  // namespace vtm::gl
