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

/// What a call may change beyond what each does: the program, the array buffer, the vertex array, unpacking,
/// the active unit, textures of unit 0. What it does not change is not asked for.
struct Touched {
    bool drawing = true;   ///< framebuffers, viewport, masks, tests, units of pictures
    bool blending = true;  ///< blend functions and equations
    bool layers = true;    ///< units of layers: Placements, Backdrop
    bool reading = true;   ///< packing

    static constexpr Touched uploads() { return {false, false, false, false}; }
    /// Of one picture: nothing else is blended.
    static constexpr Touched picture(bool over) { return {true, over, false, false}; }
};

/// From its beginning GL is in the state that our drawing relies on, whatever was there: nothing that
/// discards, tests, masks, blends or dithers fragments, no samplers, plain rows of pixels in client memory.
/// At its end all is as it was, if asked for.
class StateGuard {
public:
    StateGuard(const StateContract& contract, bool restore, Touched touched = {});
    ~StateGuard();
    StateGuard(const StateGuard&) = delete;
    StateGuard& operator=(const StateGuard&) = delete;

    /// The framebuffer that was bound for drawing.
    GLuint drawFramebuffer() const { return drawFramebuffer_; }

private:
    static constexpr std::size_t pixelStoreCount = 4;  ///< each of packing, of unpacking

    struct BoundUnit {
        GLuint texture, sampler;
    };

    bool touches(std::size_t unit) const;
    void save();
    void saveDrawing();
    void restoreDrawing() const;
    void prepare() const;
    void restore() const;

    const StateContract& contract_;
    bool restores_;
    Touched touched_;
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
    std::array<GLint, pixelStoreCount> pack_{}, unpack_{};
    std::vector<bool> enabled_;  ///< as contract_.capabilities()
};

}  // namespace vtm::gl
