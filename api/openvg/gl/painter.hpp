/// \file
/// Batches to pixels of textures. Everything here happens in the context's thread.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "api/openvg/gl/batch.hpp"
#include "api/openvg/gl/context.hpp"
#include "api/openvg/gl/functions.hpp"
#include "api/openvg/gl/programs.hpp"

namespace vtm::openvg::gl {

/// What the driver can do.
struct Abilities {
    std::string renderer;
    bool fetches = false;      ///< GL_EXT_shader_framebuffer_fetch
    bool drawsFloats = false;  ///< GL_EXT_color_buffer_float
    int maxSide = 0;
};

class Painter {
public:
    /// Makes a context, current in this thread. `mayFetch`: uses what the driver has. Throws
    /// std::runtime_error.
    Painter(std::shared_ptr<Discarded> discarded, bool mayFetch);

    const Abilities& abilities() const { return abilities_; }
    const gles_context::Context& context() const { return context_.made(); }

    /// GL_RGBA8, GL_R8 or, to be drawn into where drivers can, GL_RGBA32F. Null where there is no memory for
    /// it.
    TexturePointer makeTexture(GLenum format, int width, int height);
    /// Rows of bytes from the lowest one on, without gaps: four a pixel,
    /// or one.
    void upload(const Texture& texture, const Rectangle& part, const std::uint8_t* bytes);
    void download(const Texture& texture, const Rectangle& part, std::uint8_t* bytes);
    void draw(const Batch& batch);
    void finish() { gl_.Finish(); }
    /// For other contexts of the share group: when what was asked for so far is done.
    GLsync fence();
    /// What is asked for from now on waits for a fence of another context, which is deleted.
    void waitFor(GLsync fence);
    /// Throws std::runtime_error where GL has failed since the last time, or the context is lost.
    void check();

private:
    void makeBuffers();
    void uploadData(const Batch& batch);
    void uploadBlocks(const Batch& batch);
    void drawOne(const Batch& batch, std::size_t i);
    /// Parts of the target, which nothing can sample while it is drawn into.
    void copyTarget(const Texture& target, std::span<const Rectangle> parts);
    void bind(Unit unit, GLuint texture);
    void target(const Texture& texture);
    /// Rows of floats, `channels` each, into a texture that grows as needed.
    struct FloatRows {
        GLuint texture = 0;
        int rows = 0;
    };
    void uploadRows(FloatRows& to, GLenum internal, GLenum format, int columns, int channels,
                    std::span<const float> values);

    Context context_;
    Functions gl_;
    std::shared_ptr<Discarded> discarded_;
    Abilities abilities_;
    std::unique_ptr<Programs> programs_;
    GLuint framebuffer_ = 0, vertices_ = 0, instances_ = 0, blocks_ = 0;
    std::size_t blockStride_ = 0;
    FloatRows shares_, ramps_;
    TexturePointer backdrop_;
};

}  // namespace vtm::openvg::gl
