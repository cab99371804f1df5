/// \file
/// A compiled and linked GL program.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "backend_gl/core/gl.hpp"
#include "backend_gl/core/program_cache.hpp"

namespace vtm::gl {

/// A program's text: each stage is prelude.glsl, the shared constants and then the parts that were given.
struct ProgramSource {
    ProgramSource(std::string_view name, std::initializer_list<std::string_view> vertexParts,
                  std::initializer_list<std::string_view> fragmentParts);

    std::string name;
    std::vector<std::string> vertex, fragment;
};
/// One stage's strings, one after the other.
std::string joined(const std::vector<std::string>& parts);

class Program {
public:
    /// Compiles what the cache does not keep. Throws GlError with the driver's log, in which string 0 is the
    /// prelude, 1 the constants, 2 the first part.
    explicit Program(const ProgramSource& source, const ProgramCache& cache = ProgramCache());

    GLuint name() const { return program_.get(); }
    void use() const { glUseProgram(program_.get()); }
    /// -1, which GL ignores, where the program does without.
    GLint uniform(const char* name) const { return glGetUniformLocation(program_.get(), name); }

    /// Whether it was compiled, not loaded.
    bool compiled() const { return compiled_; }

private:
    ProgramHandle program_;
    bool compiled_ = true;
};

}  // namespace vtm::gl
