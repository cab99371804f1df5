/// \file
/// A compiled and linked GL program.
#pragma once

#include <initializer_list>
#include <string_view>

#include "backend_gl/src/gl.hpp"

namespace vtm::gl {

class Program {
public:
    /// Each stage is prelude.glsl, the shared constants and then `parts`. Throws GlError with the
    /// driver's log, in which string 0 is the prelude, 1 the constants, 2 the first part.
    Program(std::string_view name, std::initializer_list<std::string_view> vertexParts,
            std::initializer_list<std::string_view> fragmentParts);

    void use() const { glUseProgram(program_.get()); }
    /// -1, which GL ignores, where the program does without.
    GLint uniform(const char* name) const { return glGetUniformLocation(program_.get(), name); }

private:
    ProgramHandle program_;
};

}  // namespace vtm::gl
