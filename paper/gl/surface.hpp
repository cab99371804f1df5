/// \file
/// Triangles in space that show a picture again and again, as any texture's (rows 7 and 12).
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "backend_gl/core/gl.hpp"

namespace vtm::paper {

struct Surface {
    struct Vertex {
        glm::vec4 position;  ///< clip coordinates, y = -w being the raster's first row
        glm::vec2 st;        ///< in pictures (patterns: periods), from their upper left corner
    };
    std::vector<Vertex> vertices;
    /// Three vertices each. They are drawn in this order, each over what is there.
    std::vector<std::uint32_t> triangles;
};

/// A surface on the GPU, for the program of paper_surface_vertex.glsl.
class UploadedSurface {
public:
    /// Throws std::invalid_argument unless the triangles are whole and of its vertices.
    explicit UploadedSurface(const Surface& surface);

    /// Blends it over the target. Changes what gl::StateGuard keeps, no more.
    void draw() const;

private:
    gl::VertexArrayHandle vertexArray_;
    gl::BufferHandle vertices_, triangles_;
    GLsizei count_ = 0;
};

}  // namespace vtm::paper
