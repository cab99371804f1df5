#include "paper/gl/surface.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <stdexcept>

namespace vtm::paper {

using namespace gl;

namespace {

void requireTriangles(const Surface& surface) {
    const std::size_t count = surface.triangles.size();
    if (count % 3 != 0 || count > std::size_t(std::numeric_limits<GLsizei>::max()))
        throw std::invalid_argument("a surface's triangles have three vertices each");
    if (std::ranges::any_of(surface.triangles, [&](std::uint32_t i) { return i >= surface.vertices.size(); }))
        throw std::invalid_argument("a triangle of a surface names a vertex that there is not");
}

}  // namespace

UploadedSurface::UploadedSurface(const Surface& surface) {
    using Vertex = Surface::Vertex;
    requireTriangles(surface);
    count_ = GLsizei(surface.triangles.size());
    vertexArray_ = makeVertexArray();
    vertices_ = makeBuffer();
    triangles_ = makeBuffer();
    glBindVertexArray(vertexArray_.get());
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.get());
    glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(surface.vertices.size() * sizeof(Vertex)),
                 surface.vertices.data(), GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, triangles_.get());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(surface.triangles.size() * sizeof(std::uint32_t)),
                 surface.triangles.data(), GL_STATIC_DRAW);
    const auto attribute = [](GLuint place, GLint numbers, std::size_t offset) {
        glEnableVertexAttribArray(place);
        glVertexAttribPointer(place, numbers, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                              reinterpret_cast<const void*>(offset));
    };
    attribute(0, 4, offsetof(Vertex, position));
    attribute(1, 2, offsetof(Vertex, st));
    checkErrors("upload of a surface");
}

void UploadedSurface::draw() const {
    glBindVertexArray(vertexArray_.get());
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glDrawElements(GL_TRIANGLES, count_, GL_UNSIGNED_INT, nullptr);
    glDisable(GL_BLEND);
}

}  // namespace vtm::paper
