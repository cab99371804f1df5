#include "backend_gl/core/program.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include <vtm/image/codec.hpp>
#include "backend_gl/core/constants.hpp"
#include "backend_gl/core/shader_text.hpp"

namespace vtm::gl {

namespace {

namespace fs = std::filesystem;

/// Changes with the files' form.
constexpr char magic[8] = {'V', 'T', 'M', 'P', 'R', 'O', 'G', '1'};

/// Before the driver's bytes.
struct Header {
    char magic[8] = {};
    std::uint64_t size = 0, checksum = 0;
    std::uint32_t format = 0, unused = 0;
};
static_assert(sizeof(Header) == 32);

/// FNV-1a, 64 bits; `basis` begins with the standard one or another.
std::uint64_t hash(std::string_view text, std::uint64_t basis = 0xcbf29ce484222325) {
    for (const char c : text)
        basis = (basis ^ std::uint8_t(c)) * 0x100000001b3;
    return basis;
}

std::string glText(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text == nullptr ? "" : reinterpret_cast<const char*>(text);
}

std::vector<GLint> formats() {
    std::vector<GLint> list(std::size_t(std::max(limit(GL_NUM_PROGRAM_BINARY_FORMATS), 0)));
    if (!list.empty())
        glGetIntegerv(GL_PROGRAM_BINARY_FORMATS, list.data());
    return list;
}

std::string readAll(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

ProgramCache::ProgramCache(const std::string& directory) {
    if (directory.empty() || formats().empty())
        return;
    directory_ = directory;
    driver_ = glText(GL_VENDOR) + '\n' + glText(GL_RENDERER) + '\n' + glText(GL_VERSION) + '\n';
}

std::string ProgramCache::pathOf(std::string_view text) const {
    const std::uint64_t one = hash(text, hash(driver_)), other = hash(driver_, hash(text));
    return (fs::path(directory_) / fmt::format("{:016x}{:016x}.program", one, other)).string();
}

std::optional<ProgramHandle> ProgramCache::load(std::string_view text) const {
    if (!keeps())
        return std::nullopt;
    const std::string file = readAll(pathOf(text));
    Header header;
    if (file.size() < sizeof(header))
        return std::nullopt;
    std::memcpy(&header, file.data(), sizeof(header));
    const std::string_view binary = std::string_view(file).substr(sizeof(header));
    const std::vector<GLint> known = formats();
    if (std::memcmp(header.magic, magic, sizeof(magic)) != 0 || header.size != binary.size() ||
        header.checksum != hash(binary) || std::ranges::find(known, GLint(header.format)) == known.end())
        return std::nullopt;
    ProgramHandle program(glCreateProgram());
    glProgramBinary(program.get(), header.format, binary.data(), GLsizei(binary.size()));
    GLint linked = GL_FALSE;
    glGetProgramiv(program.get(), GL_LINK_STATUS, &linked);
    dropErrors();
    if (!linked)
        return std::nullopt;
    return program;
}

void ProgramCache::store(std::string_view text, const ProgramHandle& program) const {
    if (!keeps())
        return;
    GLint size = 0;
    glGetProgramiv(program.get(), GL_PROGRAM_BINARY_LENGTH, &size);
    if (size <= 0)
        return;
    std::string binary(std::size_t(size), '\0');
    GLsizei length = 0;
    GLenum format = 0;
    glGetProgramBinary(program.get(), size, &length, &format, binary.data());
    if (glGetError() != GL_NO_ERROR)
        return;
    binary.resize(std::size_t(length));
    Header header;
    std::memcpy(header.magic, magic, sizeof(magic));
    header.size = binary.size();
    header.checksum = hash(binary);
    header.format = format;

    std::vector<std::uint8_t> file(sizeof(header) + binary.size());
    std::memcpy(file.data(), &header, sizeof(header));
    std::memcpy(file.data() + sizeof(header), binary.data(), binary.size());
    std::error_code ignored;
    fs::create_directories(directory_, ignored);
    try {
        image::writeFile(pathOf(text), file);
    } catch (const image::CodecError&) {
        // The program is compiled again next time.
    }
}

namespace {

std::vector<std::string> stage(std::initializer_list<std::string_view> parts) {
    std::vector<std::string> texts{std::string(shaders::prelude), glslConstants()};
    texts.insert(texts.end(), parts.begin(), parts.end());
    return texts;
}

ShaderHandle begun(GLenum stage, const std::vector<std::string>& parts) {
    std::vector<const char*> texts;
    for (const std::string& part : parts)
        texts.push_back(part.c_str());
    ShaderHandle shader(glCreateShader(stage));
    glShaderSource(shader.get(), GLsizei(texts.size()), texts.data(), nullptr);
    glCompileShader(shader.get());
    return shader;
}

template <class Get>
std::string logBy(Get get, GLuint object) {
    std::string log(4096, '\0');
    GLsizei length = 0;
    get(object, GLsizei(log.size()), &length, log.data());
    log.resize(std::size_t(length));
    return log;
}

void requireCompiled(std::string_view program, const char* stage, const ShaderHandle& shader) {
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader.get(), GL_COMPILE_STATUS, &compiled);
    if (!compiled)
        throw GlError(fmt::format("{} shader of program {}: {}", stage, program,
                                  logBy(glGetShaderInfoLog, shader.get())));
}

/// Of GL_KHR_parallel_shader_compile.
constexpr GLenum completionStatus = 0x91B1;

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

Program::Program(const ProgramSource& source, const ProgramCache& cache) : Program(begin(source, cache)) {
    complete(cache);
}

Program Program::begin(const ProgramSource& source, const ProgramCache& cache) {
    Program program;
    std::string text = cache.keeps() ? joined(source.vertex) + '\0' + joined(source.fragment) : std::string();
    if (std::optional<ProgramHandle> kept = cache.load(text)) {
        program.program_ = std::move(*kept);
        program.compiled_ = false;
        return program;
    }
    const GLuint name = glCreateProgram();
    program.program_ = ProgramHandle(name);
    program.pending_ = Pending{source.name, std::move(text), begun(GL_VERTEX_SHADER, source.vertex),
                               begun(GL_FRAGMENT_SHADER, source.fragment)};
    glAttachShader(name, program.pending_->vertex.get());
    glAttachShader(name, program.pending_->fragment.get());
    if (cache.keeps())
        glProgramParameteri(name, GL_PROGRAM_BINARY_RETRIEVABLE_HINT, GL_TRUE);
    glLinkProgram(name);
    return program;
}

bool Program::isReady() const {
    if (isComplete() || !hasExtension("GL_KHR_parallel_shader_compile"))
        return true;
    GLint completed = GL_FALSE;
    glGetProgramiv(program_.get(), completionStatus, &completed);
    return completed == GL_TRUE;
}

void Program::complete(const ProgramCache& cache) {
    if (isComplete())
        return;
    requireCompiled(pending_->name, "vertex", pending_->vertex);
    requireCompiled(pending_->name, "fragment", pending_->fragment);
    GLint linked = GL_FALSE;
    glGetProgramiv(program_.get(), GL_LINK_STATUS, &linked);
    if (!linked)
        throw GlError(fmt::format("program {} does not link: {}", pending_->name,
                                  logBy(glGetProgramInfoLog, program_.get())));
    cache.store(pending_->text, program_);
    pending_.reset();
}

}  // namespace vtm::gl
