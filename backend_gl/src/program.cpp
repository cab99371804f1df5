#include "backend_gl/src/program.hpp"

#include <vector>

#include <fmt/format.h>

#include "backend_gl/src/constants.hpp"
#include "backend_gl/src/shader_text.hpp"

namespace vtm::gl {

namespace {

ShaderHandle compile(std::string_view program, GLenum stage, std::initializer_list<std::string_view> parts) {
    const std::string constants = glslConstants();
    std::vector<const char*> texts;
    std::vector<GLint> lengths;
    const auto add = [&](std::string_view text) {
        texts.push_back(text.data());
        lengths.push_back(GLint(text.size()));
    };
    add(shaders::prelude);
    add(constants);
    for (const std::string_view part : parts)
        add(part);

    ShaderHandle shader(glCreateShader(stage));
    glShaderSource(shader.get(), GLsizei(texts.size()), texts.data(), lengths.data());
    glCompileShader(shader.get());
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader.get(), GL_COMPILE_STATUS, &compiled);
    if (compiled)
        return shader;
    std::string log(4096, '\0');
    GLsizei length = 0;
    glGetShaderInfoLog(shader.get(), GLsizei(log.size()), &length, log.data());
    log.resize(std::size_t(length));
    throw GlError(fmt::format("{} shader of program {}: {}",
                              stage == GL_VERTEX_SHADER ? "vertex" : "fragment", program, log));
}

}  // namespace

Program::Program(std::string_view name, std::initializer_list<std::string_view> vertexParts,
                 std::initializer_list<std::string_view> fragmentParts)
    : program_(glCreateProgram()) {
    const ShaderHandle vertex = compile(name, GL_VERTEX_SHADER, vertexParts);
    const ShaderHandle fragment = compile(name, GL_FRAGMENT_SHADER, fragmentParts);
    glAttachShader(program_.get(), vertex.get());
    glAttachShader(program_.get(), fragment.get());
    glLinkProgram(program_.get());
    GLint linked = GL_FALSE;
    glGetProgramiv(program_.get(), GL_LINK_STATUS, &linked);
    if (linked)
        return;
    std::string log(4096, '\0');
    GLsizei length = 0;
    glGetProgramInfoLog(program_.get(), GLsizei(log.size()), &length, log.data());
    log.resize(std::size_t(length));
    throw GlError(fmt::format("program {} does not link: {}", name, log));
}

}  // namespace vtm::gl
