#include "backend_gl/core/state_guard.hpp"

#include <array>

namespace vtm::gl {

namespace {

/// Of ES 3.1 and of extensions whose headers need not be there.
constexpr GLenum sampleMask = 0x8E51, sampleAlphaToOne = 0x809F, framebufferSrgb = 0x8DB9;
constexpr GLenum clipDistance0 = 0x3000, clipDistanceCount = 8;

struct PixelStore {
    GLenum name;
    GLint wanted;
};
using PixelStores = std::array<PixelStore, 4>;
constexpr PixelStores packing{
    {{GL_PACK_ALIGNMENT, 4}, {GL_PACK_ROW_LENGTH, 0}, {GL_PACK_SKIP_ROWS, 0}, {GL_PACK_SKIP_PIXELS, 0}}};
constexpr PixelStores unpacking{{{GL_UNPACK_ALIGNMENT, 4},
                                 {GL_UNPACK_ROW_LENGTH, 0},
                                 {GL_UNPACK_SKIP_ROWS, 0},
                                 {GL_UNPACK_SKIP_PIXELS, 0}}};

GLuint object(GLenum binding) { return GLuint(limit(binding)); }

bool isTrue(GLenum name) {
    GLboolean value = GL_FALSE;
    glGetBooleanv(name, &value);
    return value == GL_TRUE;
}

void setEnabled(GLenum name, bool enabled) { enabled ? glEnable(name) : glDisable(name); }

std::array<GLint, 4> valuesOf(const PixelStores& stores) {
    std::array<GLint, 4> values{};
    for (std::size_t i = 0; i < stores.size(); ++i)
        values[i] = limit(stores[i].name);
    return values;
}

void setPixelStores(const PixelStores& stores) {
    for (const PixelStore& store : stores)
        glPixelStorei(store.name, store.wanted);
}

void setPixelStores(const PixelStores& stores, const std::array<GLint, 4>& values) {
    for (std::size_t i = 0; i < stores.size(); ++i)
        glPixelStorei(stores[i].name, values[i]);
}

}  // namespace

StateContract::StateContract() {
    for (const GLenum name :
         {GL_BLEND, GL_CULL_FACE, GL_DEPTH_TEST, GL_DITHER, GL_RASTERIZER_DISCARD,
          GL_SAMPLE_ALPHA_TO_COVERAGE, GL_SAMPLE_COVERAGE, GL_SCISSOR_TEST, GL_STENCIL_TEST})
        capabilities_.push_back({GLenum(name), false});
    const GLint minor = limit(GL_MINOR_VERSION);
    if (limit(GL_MAJOR_VERSION) > 3 || minor >= 1)
        capabilities_.push_back({sampleMask, false});
    if (hasExtension("GL_EXT_multisample_compatibility"))
        capabilities_.push_back({sampleAlphaToOne, false});
    if (hasExtension("GL_EXT_clip_cull_distance"))
        for (GLenum i = 0; i < clipDistanceCount; ++i)
            capabilities_.push_back({clipDistance0 + i, false});
    if (hasExtension("GL_EXT_sRGB_write_control"))
        capabilities_.push_back({framebufferSrgb, true});
}

StateGuard::StateGuard(const StateContract& contract, bool restore, Touched touched)
    : contract_(contract),
      restores_(restore),
      touched_(touched),
      pausesFeedback_(isTrue(GL_TRANSFORM_FEEDBACK_ACTIVE) && !isTrue(GL_TRANSFORM_FEEDBACK_PAUSED)),
      drawFramebuffer_(object(GL_DRAW_FRAMEBUFFER_BINDING)) {
    // Else a program could not be chosen. It goes on with the one that it began with.
    if (pausesFeedback_)
        glPauseTransformFeedback();
    if (restores_)
        save();
    prepare();
}

StateGuard::~StateGuard() {
    if (restores_)
        restore();
    if (pausesFeedback_ && restores_)
        glResumeTransformFeedback();
}

bool StateGuard::touches(std::size_t unit) const {
    const bool ofLayers = unit == std::size_t(Unit::Placements) || unit == std::size_t(Unit::Backdrop);
    return unit == 0 || (touched_.drawing && (touched_.layers || !ofLayers));
}

void StateGuard::save() {
    program_ = object(GL_CURRENT_PROGRAM);
    vertexArray_ = object(GL_VERTEX_ARRAY_BINDING);
    arrayBuffer_ = object(GL_ARRAY_BUFFER_BINDING);
    unpackBuffer_ = object(GL_PIXEL_UNPACK_BUFFER_BINDING);
    unpack_ = valuesOf(unpacking);
    activeTexture_ = GLenum(limit(GL_ACTIVE_TEXTURE));
    for (std::size_t i = 0; i < units_.size(); ++i)
        if (touches(i)) {
            glActiveTexture(GL_TEXTURE0 + GLenum(i));
            units_[i] = {object(GL_TEXTURE_BINDING_2D), object(GL_SAMPLER_BINDING)};
        }
    if (touched_.reading) {
        packBuffer_ = object(GL_PIXEL_PACK_BUFFER_BINDING);
        pack_ = valuesOf(packing);
    }
    if (touched_.blending) {
        blendFunctions_ = {GLenum(limit(GL_BLEND_SRC_RGB)), GLenum(limit(GL_BLEND_DST_RGB)),
                           GLenum(limit(GL_BLEND_SRC_ALPHA)), GLenum(limit(GL_BLEND_DST_ALPHA))};
        blendEquations_ = {GLenum(limit(GL_BLEND_EQUATION_RGB)), GLenum(limit(GL_BLEND_EQUATION_ALPHA))};
    }
    if (touched_.drawing)
        saveDrawing();
}

void StateGuard::saveDrawing() {
    readFramebuffer_ = object(GL_READ_FRAMEBUFFER_BINDING);
    glGetIntegerv(GL_VIEWPORT, viewport_.data());
    glGetIntegerv(GL_SCISSOR_BOX, scissor_.data());
    glGetBooleanv(GL_COLOR_WRITEMASK, colorMask_.data());
    for (const StateContract::Capability& capability : contract_.capabilities())
        enabled_.push_back(glIsEnabled(capability.name) == GL_TRUE);
}

void StateGuard::prepare() const {
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    setPixelStores(unpacking);
    for (std::size_t i = 0; i < units_.size(); ++i)
        if (touches(i))
            glBindSampler(GLuint(i), 0);
    glActiveTexture(GL_TEXTURE0);
    if (touched_.reading) {
        glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
        setPixelStores(packing);
    }
    if (touched_.blending)
        glBlendEquation(GL_FUNC_ADD);
    if (!touched_.drawing)
        return;
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    for (const StateContract::Capability& capability : contract_.capabilities())
        setEnabled(capability.name, capability.wanted);
}

void StateGuard::restore() const {
    // One that was deleted while it was current is gone once another is.
    glUseProgram(glIsProgram(program_) ? program_ : 0);
    glBindVertexArray(vertexArray_);
    glBindBuffer(GL_ARRAY_BUFFER, arrayBuffer_);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, unpackBuffer_);
    setPixelStores(unpacking, unpack_);
    for (std::size_t i = 0; i < units_.size(); ++i)
        if (touches(i)) {
            glActiveTexture(GL_TEXTURE0 + GLenum(i));
            glBindTexture(GL_TEXTURE_2D, units_[i].texture);
            glBindSampler(GLuint(i), units_[i].sampler);
        }
    glActiveTexture(activeTexture_);
    if (touched_.reading) {
        glBindBuffer(GL_PIXEL_PACK_BUFFER, packBuffer_);
        setPixelStores(packing, pack_);
    }
    if (touched_.blending) {
        glBlendFuncSeparate(blendFunctions_[0], blendFunctions_[1], blendFunctions_[2], blendFunctions_[3]);
        glBlendEquationSeparate(blendEquations_[0], blendEquations_[1]);
    }
    if (touched_.drawing)
        restoreDrawing();
}

void StateGuard::restoreDrawing() const {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, drawFramebuffer_);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, readFramebuffer_);
    glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
    glScissor(scissor_[0], scissor_[1], scissor_[2], scissor_[3]);
    glColorMask(colorMask_[0], colorMask_[1], colorMask_[2], colorMask_[3]);
    for (std::size_t i = 0; i < enabled_.size(); ++i)
        setEnabled(contract_.capabilities()[i].name, enabled_[i]);
}

}  // namespace vtm::gl
