#include "backend_gl/output/boxes.hpp"

#include <cstddef>

namespace vtm::gl {

Box boxOf(const PixelBox& pixels, glm::ivec2 maskOffset, std::uint32_t paint) {
    return {{pixels.min.x, pixels.min.y},
            {pixels.max.x, pixels.max.y},
            {maskOffset.x, maskOffset.y},
            GLint(paint),
            0};
}

void pointAttribute(GLuint index, GLenum type, std::size_t stride, std::size_t offset) {
    glEnableVertexAttribArray(index);
    glVertexAttribDivisor(index, 1);
    glVertexAttribIPointer(index, 4, type, GLsizei(stride), reinterpret_cast<const void*>(offset));
}

void drawBoxes(const BufferHandle& buffer, const std::vector<Box>& boxes) {
    glBindBuffer(GL_ARRAY_BUFFER, buffer.get());
    glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(boxes.size() * sizeof(Box)), boxes.data(), GL_STREAM_DRAW);
    pointAttribute(0, GL_INT, sizeof(Box), 0);
    pointAttribute(1, GL_INT, sizeof(Box), offsetof(Box, maskOffset));
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, GLsizei(boxes.size()));
}

}  // namespace vtm::gl
