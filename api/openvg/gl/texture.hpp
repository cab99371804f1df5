/// \file
/// Textures of the compositor's context.
#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include <GLES3/gl3.h>

namespace vtm::openvg::gl {

/// Names of textures that nobody needs any more, until the context's thread deletes them.
class Discarded {
public:
    void add(GLuint name) {
        const std::lock_guard lock(mutex_);
        names_.push_back(name);
    }
    std::vector<GLuint> take() {
        const std::lock_guard lock(mutex_);
        return std::exchange(names_, {});
    }

private:
    std::mutex mutex_;
    std::vector<GLuint> names_;
};

class Texture {
public:
    /// `format`: GL_RED, GL_RGB or GL_RGBA, in eight bits.
    Texture(std::shared_ptr<Discarded> discarded, GLuint name, int width, int height, GLenum format)
        : discarded_(std::move(discarded)), name_(name), width_(width), height_(height), format_(format) {}
    ~Texture() { discarded_->add(name_); }
    Texture(const Texture&) = delete;
    Texture& operator=(const Texture&) = delete;

    GLuint name() const { return name_; }
    int width() const { return width_; }
    int height() const { return height_; }
    GLenum format() const { return format_; }

private:
    std::shared_ptr<Discarded> discarded_;
    GLuint name_;
    int width_, height_;
    GLenum format_;
};

using TexturePointer = std::shared_ptr<const Texture>;

}  // namespace vtm::openvg::gl
