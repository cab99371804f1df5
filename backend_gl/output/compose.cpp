#include "backend_gl/output/compose.hpp"

#include "backend_gl/output/boxes.hpp"

namespace vtm::gl {

namespace {

void makeTransparent() {
    const GLfloat transparent[4] = {0, 0, 0, 0};
    glClearBufferfv(GL_COLOR, 0, transparent);
}

void blendOver(bool over) {
    if (!over)
        return glDisable(GL_BLEND);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

}  // namespace

void begin(const Destination& d, const PixelBox& box) {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, d.framebuffer);
    glViewport(0, 0, d.view.width, d.view.height);
    glEnable(GL_SCISSOR_TEST);
    glScissor(box.min.x, box.min.y, box.size().x, box.size().y);
    if (!d.over)
        makeTransparent();
    blendOver(d.over);
}

void end() {
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
}

void compose(Resources& resources, const Destination& d, const Target& target, const PixelBox& box,
             glm::ivec2 toTarget) {
    const Program& program = resources.programs.compose(d.finish);
    program.use();
    glUniform2f(program.uniform("targetSize"), float(d.view.width), float(d.view.height));
    glActiveTexture(GL_TEXTURE0 + GLenum(Unit::Layer));
    glBindTexture(GL_TEXTURE_2D, target.texture.get());
    glBindVertexArray(resources.vertexArray.get());
    drawBoxes(resources.boxes, {boxOf(box, toTarget)});
}

std::uint8_t* ByteSender::room(glm::ivec2 size) {
    pixels_.resize(std::size_t(size.x) * std::size_t(size.y) * 4);
    return pixels_.data();
}

void ByteSender::draw(Resources& resources, const Destination& d, const PixelBox& box) {
    const glm::ivec2 size = box.size();
    Target target = pool_.take(size, GL_RGBA8);
    glBindTexture(GL_TEXTURE_2D, target.texture.get());
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size.x, size.y, GL_RGBA, GL_UNSIGNED_BYTE, pixels_.data());
    if (d.over || d.multisampled || d.finish.flags() != 0 || d.bits != 8) {
        begin(d, box);
        compose(resources, d, target, box, -box.min);
    } else {
        glBindFramebuffer(GL_READ_FRAMEBUFFER, target.framebuffer.get());
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, d.framebuffer);
        glBlitFramebuffer(0, 0, size.x, size.y, box.min.x, box.min.y, box.max.x, box.max.y,
                          GL_COLOR_BUFFER_BIT, GL_NEAREST);
    }
    end();
    pool_.giveBack(std::move(target));
    pool_.dropUnused();
}

}  // namespace vtm::gl
