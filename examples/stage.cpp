#include "examples/stage.hpp"

#include <algorithm>

#include <glm/gtc/type_ptr.hpp>

#include <vtm/compiler/compile.hpp>
#include <vtm/image/codec.hpp>
#include <vtm/svg/load.hpp>

namespace stage {

namespace {

constexpr int samples = 4;

constexpr const char* vertexText = R"(#version 300 es
uniform mat4 camera;
uniform vec3 corner, right, down;
uniform vec2 copies;
out vec2 st;
out vec3 place, normal;
void main() {
    vec2 at = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    st = at * copies;
    place = corner + at.x * right + at.y * down;
    normal = normalize(cross(down, right));
    gl_Position = camera * vec4(place, 1.0);
})";

GLuint compile(GLenum stage, const std::string& text) {
    const GLuint shader = glCreateShader(stage);
    const char* start = text.c_str();
    glShaderSource(shader, 1, &start, nullptr);
    glCompileShader(shader);
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    char log[4096] = "";
    glGetShaderInfoLog(shader, sizeof log, nullptr, log);
    if (!compiled)
        throw vtm::gl::GlError(log);
    return shader;
}

}  // namespace

vtm::asset::Asset load(const std::string& svg) {
    return vtm::compiler::compile(vtm::svg::load(vtm::image::readFile(svg)).scene).asset;
}

GLuint program(const std::string& head, const std::string& fragment) {
    const GLuint program = glCreateProgram();
    glAttachShader(program, compile(GL_VERTEX_SHADER, vertexText));
    glAttachShader(program, compile(GL_FRAGMENT_SHADER, "#version 300 es\n" + head + R"(
in vec2 st;
in vec3 place, normal;
out vec4 color;
#line 1
)" + fragment));
    glLinkProgram(program);
    GLint linked = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (!linked)
        throw vtm::gl::GlError("a program does not link");
    return program;
}

void draw(GLuint program, const glm::mat4& camera, const Quad& quad) {
    glUseProgram(program);
    glUniformMatrix4fv(glGetUniformLocation(program, "camera"), 1, GL_FALSE, glm::value_ptr(camera));
    glUniform3fv(glGetUniformLocation(program, "corner"), 1, glm::value_ptr(quad.corner));
    glUniform3fv(glGetUniformLocation(program, "right"), 1, glm::value_ptr(quad.right));
    glUniform3fv(glGetUniformLocation(program, "down"), 1, glm::value_ptr(quad.down));
    glUniform2fv(glGetUniformLocation(program, "copies"), 1, glm::value_ptr(quad.copies));
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

Canvas::Canvas(int width, int height, glm::vec3 background) : width_(width), height_(height) {
    glGenFramebuffers(2, framebuffers_);
    glGenRenderbuffers(2, color_);
    glGenRenderbuffers(1, &depth_);
    for (const int resolved : {1, 0}) {  // the multisampled one stays bound
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffers_[resolved]);
        glBindRenderbuffer(GL_RENDERBUFFER, color_[resolved]);
        glRenderbufferStorageMultisample(GL_RENDERBUFFER, resolved ? 0 : samples, GL_RGBA8, width, height);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_[resolved]);
    }
    glBindRenderbuffer(GL_RENDERBUFFER, depth_);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_DEPTH_COMPONENT24, width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
    glViewport(0, 0, width, height);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glClearColor(background.r, background.g, background.b, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

Canvas::~Canvas() {
    glDeleteFramebuffers(2, framebuffers_);
    glDeleteRenderbuffers(2, color_);
    glDeleteRenderbuffers(1, &depth_);
}

void Canvas::save(const std::string& path) const {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffers_[0]);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffers_[1]);
    glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffers_[1]);
    vtm::image::Bitmap bitmap{width_, height_, std::vector<std::uint8_t>(std::size_t(width_) * height_ * 4)};
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, bitmap.rgba.data());
    const std::size_t row = std::size_t(width_) * 4;
    for (int y = 0; y < height_ / 2; ++y)  // GL's rows run upwards
        std::swap_ranges(bitmap.rgba.begin() + long(y * row), bitmap.rgba.begin() + long((y + 1) * row),
                         bitmap.rgba.end() - long((y + 1) * row));
    vtm::image::writeFile(path, vtm::image::encodePng(bitmap));
}

}  // namespace stage
