/// \file
/// A user's GL state, as it was.
#pragma once

#include <array>

#include "backend_gl/src/gl.hpp"

namespace vtm::gl {

/// What uploading textures changes, set to GL's defaults and put back at the end of the scope: the active
/// unit's 2D texture, the pixel unpack buffer and how rows are unpacked.
class SavedUploadState {
public:
    SavedUploadState();
    ~SavedUploadState();
    SavedUploadState(const SavedUploadState&) = delete;
    SavedUploadState& operator=(const SavedUploadState&) = delete;

private:
    GLint texture_, buffer_;
    std::array<GLint, 4> unpack_;
};

/// What binding to a program changes on the way: the current program and the active unit.
class SavedBindState {
public:
    SavedBindState();
    ~SavedBindState();
    SavedBindState(const SavedBindState&) = delete;
    SavedBindState& operator=(const SavedBindState&) = delete;

private:
    GLint program_, unit_;
};

}  // namespace vtm::gl
