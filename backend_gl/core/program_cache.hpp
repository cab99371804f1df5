/// \file
/// Linked programs on disk, as the driver's binaries.
#pragma once

#include <optional>
#include <string>
#include <string_view>

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

}  // namespace vtm::gl
