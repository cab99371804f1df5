/// \file
/// The compositor's programs, each compiled when it is first needed.
#pragma once

#include <map>
#include <stdexcept>
#include <string>

#include "api/openvg/gl/batch.hpp"
#include "api/openvg/gl/functions.hpp"

namespace vtm::openvg::gl {

/// Texture units, the same in every program.
enum class Unit : int { shares, source, other, mask, ramps, backdrop };

/// The driver does not take a program; its context goes on.
class ProgramError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct ProgramText {
    std::string vertex, fragment;
};
/// `fetches`: by GL_EXT_shader_framebuffer_fetch. Otherwise the text is WebGL 2's too.
ProgramText programText(const ProgramKey& key, bool fetches);

/// All are deleted with their context. Used in its thread only.
class Programs {
public:
    Programs(const Functions& gl, bool fetches) : gl_(gl), fetches_(fetches) {}

    /// Makes it current. Throws ProgramError with the driver's log.
    void use(const ProgramKey& key);

private:
    GLuint compile(GLenum stage, const std::string& text);
    GLuint link(const ProgramKey& key);

    const Functions& gl_;
    bool fetches_;
    std::map<ProgramKey, GLuint> programs_;
};

}  // namespace vtm::openvg::gl
