#include "backend_gl/testing.hpp"

#include <glm/matrix.hpp>

#include "backend_gl/core/gl.hpp"

namespace vtm::gl::test {

namespace {

/// The first three vertices hold the whole raster.
constexpr const char* vertexText = R"(#version 300 es
void main() {
    gl_Position = vec4(vec2((gl_VertexID & 1) * 4 - 1, (gl_VertexID >> 1) * 4 - 1), 0.0, 1.0);
})";

constexpr const char* mainText = R"(
out vec4 canvasColor;
void main() { canvasColor = shade(gl_FragCoord.xy); })";

ShaderHandle compile(GLenum stage, const std::string& text) {
    ShaderHandle shader(glCreateShader(stage));
    const char* start = text.c_str();
    glShaderSource(shader.get(), 1, &start, nullptr);
    glCompileShader(shader.get());
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader.get(), GL_COMPILE_STATUS, &compiled);
    std::string log(8192, '\0');
    GLsizei length = 0;
    if (!compiled) {
        glGetShaderInfoLog(shader.get(), GLsizei(log.size()), &length, log.data());
        throw GlError(log.substr(0, std::size_t(length)));
    }
    return shader;
}

ProgramHandle link(const std::string& vertices, const std::string& fragmentText) {
    const ShaderHandle vertex = compile(GL_VERTEX_SHADER, vertices),
                       fragment = compile(GL_FRAGMENT_SHADER, fragmentText);
    ProgramHandle program(glCreateProgram());
    glAttachShader(program.get(), vertex.get());
    glAttachShader(program.get(), fragment.get());
    glLinkProgram(program.get());
    GLint linked = GL_FALSE;
    glGetProgramiv(program.get(), GL_LINK_STATUS, &linked);
    std::string log(8192, '\0');
    GLsizei length = 0;
    if (!linked) {
        glGetProgramInfoLog(program.get(), GLsizei(log.size()), &length, log.data());
        throw GlError(log.substr(0, std::size_t(length)));
    }
    return program;
}

}  // namespace

struct ShaderCanvas::Impl {
    ProgramHandle program;
    VertexArrayHandle vertices = makeVertexArray();
    FramebufferHandle framebuffer = makeFramebuffer();
    TextureHandle target;
    int width = 0, height = 0;

    void resize(int w, int h) {
        if (w == width && h == height)
            return;
        glActiveTexture(GL_TEXTURE0 + GLenum(limit(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS) - 1));
        target = makeTexture(GL_RGBA32F, w, h);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.get());
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.get(), 0);
        if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
            throw GlError("the driver cannot draw into RGBA32F");
        width = w;
        height = h;
    }
};

ShaderCanvas::ShaderCanvas(const std::string& include, const std::string& text, const std::string& vertices)
    : impl_(std::make_unique<Impl>()) {
    impl_->program =
        link(vertices.empty() ? vertexText : vertices, "#version 300 es\n" + include + text + mainText);
}
ShaderCanvas::~ShaderCanvas() = default;

unsigned ShaderCanvas::program() const { return impl_->program.get(); }

void ShaderCanvas::set(const char* name, const glm::dmat3& value) {
    const glm::mat3 m(value);
    glUseProgram(program());
    glUniformMatrix3fv(glGetUniformLocation(program(), name), 1, GL_FALSE, &m[0][0]);
}

void ShaderCanvas::drawOnly(int width, int height) {
    impl_->resize(width, height);
    glBindFramebuffer(GL_FRAMEBUFFER, impl_->framebuffer.get());
    glViewport(0, 0, width, height);
    glBindVertexArray(impl_->vertices.get());
    glUseProgram(program());
    for (const GLenum state : {GL_DEPTH_TEST, GL_STENCIL_TEST, GL_SCISSOR_TEST, GL_CULL_FACE, GL_BLEND})
        glDisable(state);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    glFinish();
    checkErrors("drawing on a canvas");
}

image::Raster ShaderCanvas::draw(int width, int height) {
    drawOnly(width, height);
    image::Raster raster(width, height);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glPixelStorei(GL_PACK_ROW_LENGTH, 0);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, raster.rgba.data());
    checkErrors("reading a canvas");
    return raster;
}

TextureCanvas::TextureCanvas(const asset::AssetView& asset)
    : size_(asset.width, asset.height), texture_(asset), canvas_(sampleInclude({asset}), R"(
uniform Vtm picture;
uniform mat3 toPicture;
vec4 shade(vec2 pixel) {
    vec3 p = toPicture * vec3(pixel, 1.0);
    return vtm_sample_proj(picture, p);
})") {}

image::Raster TextureCanvas::draw(const glm::dmat3& toPicture, int width, int height, Wrapping wrapping) {
    texture_.bind(canvas_.program(), "picture", 0, wrapping);
    canvas_.set("toPicture", toPicture);
    return canvas_.draw(width, height);
}

image::Raster TextureCanvas::draw(const asset::View& view, Wrapping wrapping) {
    const glm::dmat3 toPixels(glm::dvec3(view.toPixels[0], 0), glm::dvec3(view.toPixels[1], 0),
                              glm::dvec3(view.toPixels[2], 1));
    const glm::dmat3 toUnit(1 / size_.x, 0, 0, 0, 1 / size_.y, 0, 0, 0, 1);
    return draw(toUnit * glm::inverse(toPixels), view.width, view.height, wrapping);
}

}  // namespace vtm::gl::test
