#include "backend_gl/core/program.hpp"

#include <optional>

#include <fmt/format.h>

#include "backend_gl/core/constants.hpp"
#include "backend_gl/core/shader_text.hpp"

namespace vtm::gl {

namespace {

std::vector<std::string> stage(std::initializer_list<std::string_view> parts) {
    std::vector<std::string> texts{std::string(shaders::prelude), glslConstants()};
    texts.insert(texts.end(), parts.begin(), parts.end());
    return texts;
}

ShaderHandle compile(std::string_view program, GLenum stage, const std::vector<std::string>& parts) {
    std::vector<const char*> texts;
    for (const std::string& part : parts)
        texts.push_back(part.c_str());

    ShaderHandle shader(glCreateShader(stage));
    glShaderSource(shader.get(), GLsizei(texts.size()), texts.data(), nullptr);
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

ProgramSource::ProgramSource(std::string_view programName,
                             std::initializer_list<std::string_view> vertexParts,
                             std::initializer_list<std::string_view> fragmentParts)
    : name(programName), vertex(stage(vertexParts)), fragment(stage(fragmentParts)) {}

std::string joined(const std::vector<std::string>& parts) {
    std::string text;
    for (const std::string& part : parts)
        text += part;
    return text;
}

Program::Program(const ProgramSource& source, const ProgramCache& cache) {
    const std::string text =
        cache.keeps() ? joined(source.vertex) + '\0' + joined(source.fragment) : std::string();
    if (std::optional<ProgramHandle> kept = cache.load(text)) {
        program_ = std::move(*kept);
        compiled_ = false;
        return;
    }
    program_ = ProgramHandle(glCreateProgram());
    const ShaderHandle vertex = compile(source.name, GL_VERTEX_SHADER, source.vertex);
    const ShaderHandle fragment = compile(source.name, GL_FRAGMENT_SHADER, source.fragment);
    glAttachShader(program_.get(), vertex.get());
    glAttachShader(program_.get(), fragment.get());
    if (cache.keeps())
        glProgramParameteri(program_.get(), GL_PROGRAM_BINARY_RETRIEVABLE_HINT, GL_TRUE);
    glLinkProgram(program_.get());
    GLint linked = GL_FALSE;
    glGetProgramiv(program_.get(), GL_LINK_STATUS, &linked);
    if (linked) {
        cache.store(text, program_);
        return;
    }
    std::string log(4096, '\0');
    GLsizei length = 0;
    glGetProgramInfoLog(program_.get(), GLsizei(log.size()), &length, log.data());
    log.resize(std::size_t(length));
    throw GlError(fmt::format("program {} does not link: {}", source.name, log));
}

}  // namespace vtm::gl
