/// \file
/// A user's GL state, set aside while we draw. docs/backend.md lists it as a contract.
#pragma once

#include <array>
#include <vector>

#include "backend_gl/core/gl.hpp"
#include "backend_gl/core/programs.hpp"

namespace vtm::gl {

/// What of the state the context has, asked once a renderer.
class StateContract {
public:
    StateContract();

    struct Capability {
        GLenum name;
        bool wanted;
    };
    const std::vector<Capability>& capabilities() const { return capabilities_; }

private:
    std::vector<Capability> capabilities_;
};

/// From its beginning GL is in the state that our drawing relies on, whatever was there: nothing that
/// discards, tests, masks, blends or dithers fragments, no samplers, plain rows of pixels in client memory.
/// At its end all is as it was, if asked for.
class StateGuard {
public:
    StateGuard(const StateContract& contract, bool restore);
    ~StateGuard();
    StateGuard(const StateGuard&) = delete;
    StateGuard& operator=(const StateGuard&) = delete;

    /// The framebuffer that was bound for drawing.
    GLuint drawFramebuffer() const { return drawFramebuffer_; }

private:
    static constexpr std::size_t pixelStoreCount = 8;

    struct BoundUnit {
        GLuint texture, sampler;
    };

    void save();
    void prepare() const;
    void restore() const;

    const StateContract& contract_;
    bool restores_;
    bool pausesFeedback_;
    GLuint drawFramebuffer_;

    GLuint readFramebuffer_ = 0, program_ = 0, vertexArray_ = 0;
    GLuint arrayBuffer_ = 0, packBuffer_ = 0, unpackBuffer_ = 0;
    GLenum activeTexture_ = GL_TEXTURE0;
    std::array<BoundUnit, unitCount> units_{};
    std::array<GLint, 4> viewport_{}, scissor_{};
    std::array<GLenum, 4> blendFunctions_{};
    std::array<GLenum, 2> blendEquations_{};
    std::array<GLboolean, 4> colorMask_{};
    std::array<GLint, pixelStoreCount> pixelStore_{};
    std::vector<bool> enabled_;  ///< as contract_.capabilities()
};

}  // namespace vtm::gl
