#include "backend_gl/src/saved_state.hpp"

namespace vtm::gl {

namespace {

constexpr std::array unpackNames{GL_UNPACK_ALIGNMENT, GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS,
                                 GL_UNPACK_SKIP_PIXELS};
constexpr std::array unpackDefaults{4, 0, 0, 0};

}  // namespace

SavedUploadState::SavedUploadState()
    : texture_(limit(GL_TEXTURE_BINDING_2D)), buffer_(limit(GL_PIXEL_UNPACK_BUFFER_BINDING)) {
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    for (std::size_t i = 0; i < unpackNames.size(); ++i) {
        unpack_[i] = limit(GLenum(unpackNames[i]));
        glPixelStorei(GLenum(unpackNames[i]), unpackDefaults[i]);
    }
}

SavedUploadState::~SavedUploadState() {
    for (std::size_t i = 0; i < unpackNames.size(); ++i)
        glPixelStorei(GLenum(unpackNames[i]), unpack_[i]);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, GLuint(buffer_));
    glBindTexture(GL_TEXTURE_2D, GLuint(texture_));
}

SavedBindState::SavedBindState() : program_(limit(GL_CURRENT_PROGRAM)), unit_(limit(GL_ACTIVE_TEXTURE)) {}

SavedBindState::~SavedBindState() {
    // One that was deleted while it was current is gone once another is.
    glUseProgram(glIsProgram(GLuint(program_)) ? GLuint(program_) : 0);
    glActiveTexture(GLenum(unit_));
}

}  // namespace vtm::gl
