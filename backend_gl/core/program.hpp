/// \file
/// A compiled and linked GL program, and linked programs on disk, as the driver's binaries.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "backend_gl/core/gl.hpp"

namespace vtm::gl {

/// A file a program, named by a hash of the program's text and of who compiles it: another driver, another
/// version of it or another text is another file. What cannot be read, written or linked is compiled instead,
/// without a word: a cache may lose anything. Files are written beside their place and moved there, so that
/// processes may share a directory. The driver trusts what it reads: only the user may be able to write
/// there.
class ProgramCache {
public:
    /// Keeps nothing if `directory` is empty or the driver has no formats. Needs a current context.
    explicit ProgramCache(const std::string& directory = {});

    bool keeps() const { return !directory_.empty(); }
    /// A linked program, if one is kept for this text.
    std::optional<ProgramHandle> load(std::string_view text) const;
    /// `program` was linked with GL_PROGRAM_BINARY_RETRIEVABLE_HINT.
    void store(std::string_view text, const ProgramHandle& program) const;

private:
    std::string pathOf(std::string_view text) const;

    std::string directory_;
    std::string driver_;
};

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

    /// Gives the driver what it needs to compile the program on threads of its own, and asks for nothing. It
    /// may be used after complete().
    static Program begin(const ProgramSource& source, const ProgramCache& cache);
    /// Whether complete() would not wait. Always, where the driver does not say
    /// (GL_KHR_parallel_shader_compile).
    bool isReady() const;
    /// Waits for the driver. Throws as the constructor does.
    void complete(const ProgramCache& cache);
    bool isComplete() const { return !pending_; }

    GLuint name() const { return program_.get(); }
    void use() const { glUseProgram(program_.get()); }
    /// -1, which GL ignores, where the program does without.
    GLint uniform(const char* name) const { return glGetUniformLocation(program_.get(), name); }

    /// Whether it was compiled, not loaded.
    bool compiled() const { return compiled_; }

private:
    /// What is needed until the driver has linked.
    struct Pending {
        std::string name, text;  ///< the text is for the cache
        ShaderHandle vertex, fragment;
    };

    Program() = default;

    ProgramHandle program_;
    bool compiled_ = true;
    std::optional<Pending> pending_;
};

}  // namespace vtm::gl
