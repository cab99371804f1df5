/// \file
/// Boxes of pixels, as instances of box_vertex.glsl.
#pragma once

#include <vector>

#include "backend_gl/core/gl.hpp"
#include "backend_gl/core/placement.hpp"

namespace vtm::gl {

struct Box {
    GLint min[2], max[2];
    GLint maskOffset[2];
    GLint paint, unused;
};

Box boxOf(const PixelBox& pixels, glm::ivec2 maskOffset = {0, 0}, std::uint32_t paint = 0);

/// An attribute of four integers an instance, from the bound array buffer.
void pointAttribute(GLuint index, GLenum type, std::size_t stride, std::size_t offset);

/// With the program and the vertex array that are bound; `buffer` is filled anew.
void drawBoxes(const BufferHandle& buffer, const std::vector<Box>& boxes);

}  // namespace vtm::gl
