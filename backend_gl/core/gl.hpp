/// \file
/// OpenGL ES 3.0, its errors as exceptions and its objects as values.
#pragma once

#include <string>
#include <utility>

#include <GLES3/gl3.h>

#include <vtm/gl/context.hpp>

namespace vtm::gl {

/// Throws GlError, OutOfMemory or ContextLost naming `what` if GL has an error pending.
void checkErrors(const char* what);
/// Forgets errors that are pending.
void dropErrors();

/// What EGL calls the thread's current context; null: none, or one that was not made by EGL.
const void* currentContext();

int limit(GLenum name);
bool hasExtension(const char* name);

/// Sole owner of a GL object. It is deleted only while its context is current: elsewhere its number may mean
/// another object, so it is left to its context's end.
template <void (*Delete)(GLuint)>
class Handle {
public:
    Handle() = default;
    explicit Handle(GLuint id) : id_(id), context_(currentContext()) {}
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, 0)), context_(other.context_) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(id_, other.id_);
        std::swap(context_, other.context_);
        return *this;
    }
    ~Handle() {
        if (id_ != 0 && context_ == currentContext())
            Delete(id_);
    }
    GLuint get() const { return id_; }

private:
    GLuint id_ = 0;
    const void* context_ = nullptr;
};

void deleteTexture(GLuint id);
void deleteBuffer(GLuint id);
void deleteFramebuffer(GLuint id);
void deleteVertexArray(GLuint id);
void deleteShader(GLuint id);
void deleteProgram(GLuint id);
void deleteSampler(GLuint id);

using TextureHandle = Handle<deleteTexture>;
using BufferHandle = Handle<deleteBuffer>;
using FramebufferHandle = Handle<deleteFramebuffer>;
using VertexArrayHandle = Handle<deleteVertexArray>;
using ShaderHandle = Handle<deleteShader>;
using ProgramHandle = Handle<deleteProgram>;
using SamplerHandle = Handle<deleteSampler>;

/// A texture for texelFetch: no filter, one level.
TextureHandle makeTexture(GLenum format, int width, int height);
BufferHandle makeBuffer();
VertexArrayHandle makeVertexArray();
FramebufferHandle makeFramebuffer();

}  // namespace vtm::gl
