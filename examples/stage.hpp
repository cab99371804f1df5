/// \file
/// What the examples need besides VTM, so that they hold little else: a picture to draw on and flat things to
/// draw.
#pragma once

#include <string>

#include <GLES3/gl3.h>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <vtm/asset/asset.hpp>
#include <vtm/gl/context.hpp>

namespace stage {

/// An SVG file, compiled.
vtm::asset::Asset load(const std::string& svg);

/// A program whose vertex shader places the parallelograms below. The fragment shader has
///     in vec2 st;            // (0, 0) at the corner, (copies) opposite
///     in vec3 place, normal;
///     out vec4 color;        // premultiplied
/// declared, after the includes in `head`. Throws GlError with the driver's log.
GLuint program(const std::string& head, const std::string& fragment);

/// corner + s · right + t · down, seen through `camera`, by the current program.
struct Quad {
    glm::vec3 corner, right, down;
    glm::vec2 copies{1, 1};
};
void draw(GLuint program, const glm::mat4& camera, const Quad& quad);

/// A multisampled picture with a depth buffer, current after its making: blending `over`, depth on.
class Canvas {
public:
    Canvas(int width, int height, glm::vec3 background);
    ~Canvas();
    Canvas(const Canvas&) = delete;
    Canvas& operator=(const Canvas&) = delete;

    float aspect() const { return float(width_) / float(height_); }
    /// Writes a PNG file. Throws std::runtime_error.
    void save(const std::string& path) const;

private:
    int width_, height_;
    GLuint framebuffers_[2], color_[2], depth_;
};

}  // namespace stage
