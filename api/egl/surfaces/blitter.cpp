#include "api/egl/surfaces/blitter.hpp"

#include <utility>

#include <vtm/vg_gl.h>

#include "api/egl/system/gl_functions.hpp"

namespace vtm::egl {

namespace {

constexpr const char* vertexShader =
    "attribute vec4 corner;\n"
    "varying vec2 st;\n"
    "void main() {\n"
    "    st = corner.zw;\n"
    "    gl_Position = vec4(2.0 * corner.xy - 1.0, 0.0, 1.0);\n"
    "}\n";

constexpr const char* fragmentShader =
    "#ifdef GL_FRAGMENT_PRECISION_HIGH\n"
    "precision highp float;\n"
    "#else\n"
    "precision mediump float;\n"
    "#endif\n"
    "uniform sampler2D drawing;\n"
    "varying vec2 st;\n"
    "void main() { gl_FragColor = texture2D(drawing, st); }\n";

/// Corners of the target and of a texture: of one whose rows begin at the bottom, and at the top.
constexpr float fromBottom[] = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 0, 1, 1, 1, 1, 1};
constexpr float fromTop[] = {0, 0, 0, 1, 1, 0, 1, 1, 0, 1, 0, 0, 1, 1, 1, 0};

/// Draws the texture that is bound.
void drawTexture(const float* corners) {
    gl().VertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, 0, corners);
    gl().DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

GLuint newTexture() {
    GLuint texture = 0;
    gl().GenTextures(1, &texture);
    gl().BindTexture(GL_TEXTURE_2D, texture);
    for (const GLenum name : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        gl().TexParameteri(GL_TEXTURE_2D, name, GL_NEAREST);
    for (const GLenum name : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        gl().TexParameteri(GL_TEXTURE_2D, name, GL_CLAMP_TO_EDGE);
    return texture;
}

}  // namespace

Blitter::Blitter(const Display& display, EGLConfig config, bool isOnGpu)
    : display_(display.handle), context_(isOnGpu ? newSharingContext(display, config) : EGL_NO_CONTEXT) {
    sharesTextures_ = context_ != EGL_NO_CONTEXT;
    if (!sharesTextures_)
        context_ = newGlContext(display, config);
}

Blitter::~Blitter() {
    if (context_ != EGL_NO_CONTEXT)
        systemEgl()->DestroyContext(display_, context_);
}

void Blitter::prepare() {
    const GLuint program = gl().CreateProgram();
    for (const auto& [type, text] :
         {std::pair(GL_VERTEX_SHADER, vertexShader), std::pair(GL_FRAGMENT_SHADER, fragmentShader)}) {
        const GLuint shader = gl().CreateShader(GLenum(type));
        gl().ShaderSource(shader, 1, &text, nullptr);
        gl().CompileShader(shader);
        gl().AttachShader(program, shader);
    }
    gl().BindAttribLocation(program, 0, "corner");
    gl().LinkProgram(program);
    GLint isLinked = GL_FALSE;
    gl().GetProgramiv(program, GL_LINK_STATUS, &isLinked);
    require(isLinked, EGL_BAD_ALLOC);
    gl().UseProgram(program);
    gl().ActiveTexture(GL_TEXTURE0);
    gl().Disable(GL_DITHER);
    gl().EnableVertexAttribArray(0);
    isPrepared_ = true;
}

/// The drawing's pixels, from memory.
void Blitter::upload(VtmSurface* drawing) {
    const GLsizei width = vtmSurfaceWidth(drawing), height = vtmSurfaceHeight(drawing);
    const std::size_t rowBytes = std::size_t(width) * 4;
    pixels_.resize(rowBytes * std::size_t(height));
    vtmReadSurface(drawing, pixels_.data(), rowBytes);
    if (texture_ == 0)
        texture_ = newTexture();
    gl().BindTexture(GL_TEXTURE_2D, texture_);
    if (std::exchange(width_, width) != width || std::exchange(height_, height) != height)
        gl().TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                        pixels_.data());
    else
        gl().TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels_.data());
}

void Blitter::draw(VtmSurface* drawing) {
    if (!isPrepared_)
        prepare();
    gl().Viewport(0, 0, vtmSurfaceWidth(drawing), vtmSurfaceHeight(drawing));
    VtmGlPicture picture;
    if (sharesTextures_ && vtmTakeGlPicture(drawing, &picture)) {
        const auto ready = static_cast<GLsync>(picture.ready);
        gl().WaitSync(ready, 0, GL_TIMEOUT_IGNORED);
        gl().DeleteSync(ready);
        gl().BindTexture(GL_TEXTURE_2D, picture.texture);
        drawTexture(fromBottom);
        vtmReturnGlPicture(gl().FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0));
    } else {
        upload(drawing);
        drawTexture(fromTop);
    }
    require(gl().GetError() == GL_NO_ERROR, EGL_BAD_ALLOC);
}

void Blitter::copy(EGLSurface target, VtmSurface* drawing) {
    const GlCurrent current(display_, target, context_);
    draw(drawing);
    gl().Finish();
}

void Blitter::read(EGLSurface target, VtmSurface* drawing) {
    const GlCurrent current(display_, target, context_);
    const GLsizei width = vtmSurfaceWidth(drawing), height = vtmSurfaceHeight(drawing);
    const std::size_t rowBytes = std::size_t(width) * 4;
    pixels_.resize(rowBytes * std::size_t(height));
    // OpenGL begins with the lowest row.
    for (GLsizei y = 0; y < height; ++y)
        gl().ReadPixels(0, height - 1 - y, width, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                        pixels_.data() + std::size_t(y) * rowBytes);
    require(gl().GetError() == GL_NO_ERROR, EGL_BAD_ALLOC);
    vtmWriteSurface(drawing, pixels_.data(), rowBytes);
}

void Blitter::swap(EGLSurface target, VtmSurface* drawing, EGLint interval) {
    const GlCurrent current(display_, target, context_);
    draw(drawing);
    systemEgl()->SwapInterval(display_, interval);
    requireSystem(systemEgl()->SwapBuffers(display_, target));
}

}  // namespace vtm::egl
