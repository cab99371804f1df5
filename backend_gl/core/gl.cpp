#include "backend_gl/core/gl.hpp"

#include <cstring>

#include <EGL/egl.h>
#include <fmt/format.h>

namespace vtm::gl {

namespace {

/// GL_CONTEXT_LOST of GL_KHR_robustness.
constexpr GLenum contextLost = 0x0507;

const char* errorName(GLenum error) {
    switch (error) {
        case GL_INVALID_ENUM:
            return "invalid enum";
        case GL_INVALID_VALUE:
            return "invalid value";
        case GL_INVALID_OPERATION:
            return "invalid operation";
        case GL_INVALID_FRAMEBUFFER_OPERATION:
            return "invalid framebuffer operation";
        case GL_OUT_OF_MEMORY:
            return "out of memory";
        case contextLost:
            return "context lost";
        default:
            return "unknown error";
    }
}

}  // namespace

void checkErrors(const char* what) {
    const GLenum error = glGetError();
    if (error == GL_NO_ERROR)
        return;
    const std::string message = fmt::format("{}: GL says {} (0x{:04x})", what, errorName(error), error);
    if (error == GL_OUT_OF_MEMORY)
        throw OutOfMemory(message);
    if (error == contextLost)
        throw ContextLost(message);
    throw GlError(message);
}

void dropErrors() {
    // A flag for each of GL's errors may be set; a lost context says so for ever.
    for (int i = 0; i < 8 && glGetError() != GL_NO_ERROR; ++i)
        continue;
}

const void* currentContext() { return eglGetCurrentContext(); }

int limit(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

bool hasExtension(const char* name) {
    const int count = limit(GL_NUM_EXTENSIONS);
    for (int i = 0; i < count; ++i)
        if (std::strcmp(reinterpret_cast<const char*>(glGetStringi(GL_EXTENSIONS, GLuint(i))), name) == 0)
            return true;
    return false;
}

void deleteTexture(GLuint id) { glDeleteTextures(1, &id); }
void deleteBuffer(GLuint id) { glDeleteBuffers(1, &id); }
void deleteFramebuffer(GLuint id) { glDeleteFramebuffers(1, &id); }
void deleteVertexArray(GLuint id) { glDeleteVertexArrays(1, &id); }
void deleteShader(GLuint id) { glDeleteShader(id); }
void deleteProgram(GLuint id) { glDeleteProgram(id); }
void deleteSampler(GLuint id) { glDeleteSamplers(1, &id); }

TextureHandle makeTexture(GLenum format, int width, int height) {
    const int largest = limit(GL_MAX_TEXTURE_SIZE);
    if (width > largest || height > largest)
        throw GlError(fmt::format("texture of {} x {} texels: the driver's limit is {} per side", width,
                                  height, largest));
    GLuint id = 0;
    glGenTextures(1, &id);
    TextureHandle texture(id);
    glBindTexture(GL_TEXTURE_2D, id);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
    checkErrors("texture storage");
    return texture;
}

BufferHandle makeBuffer() {
    GLuint id = 0;
    glGenBuffers(1, &id);
    return BufferHandle(id);
}

VertexArrayHandle makeVertexArray() {
    GLuint id = 0;
    glGenVertexArrays(1, &id);
    return VertexArrayHandle(id);
}

FramebufferHandle makeFramebuffer() {
    GLuint id = 0;
    glGenFramebuffers(1, &id);
    return FramebufferHandle(id);
}

}  // namespace vtm::gl
