#include "api/egl/surfaces/blitter.hpp"

#include "api/egl/system/gl_functions.hpp"

namespace vtm::egl {

namespace {

constexpr const char* vertexShader =
    "attribute vec2 corner;\n"
    "varying vec2 st;\n"
    "void main() {\n"
    "    st = vec2(corner.x, 1.0 - corner.y);\n"
    "    gl_Position = vec4(2.0 * corner - 1.0, 0.0, 1.0);\n"
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

constexpr float corners[] = {0, 0, 1, 0, 0, 1, 1, 1};

}  // namespace

Blitter::Blitter(const Display& display, EGLConfig config)
    : display_(display.handle), context_(newGlContext(display, config)) {}

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
    GLuint texture = 0;
    gl().GenTextures(1, &texture);
    gl().ActiveTexture(GL_TEXTURE0);
    gl().BindTexture(GL_TEXTURE_2D, texture);
    for (const GLenum name : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        gl().TexParameteri(GL_TEXTURE_2D, name, GL_NEAREST);
    for (const GLenum name : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        gl().TexParameteri(GL_TEXTURE_2D, name, GL_CLAMP_TO_EDGE);
    gl().Disable(GL_DITHER);
    gl().EnableVertexAttribArray(0);
    gl().VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, corners);
    isPrepared_ = true;
}

void Blitter::draw(VtmSurface* drawing) {
    if (!isPrepared_)
        prepare();
    const GLsizei width = vtmSurfaceWidth(drawing), height = vtmSurfaceHeight(drawing);
    const std::size_t rowBytes = std::size_t(width) * 4;
    pixels_.resize(rowBytes * std::size_t(height));
    vtmReadSurface(drawing, pixels_.data(), rowBytes);
    gl().Viewport(0, 0, width, height);
    gl().TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels_.data());
    gl().DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
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
