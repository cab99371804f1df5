/// \file
/// FreeType's view of a face, for what HarfBuzz does not read.
#pragma once

#include <ft2build.h>
#include FT_FREETYPE_H
#include <hb.h>

#include <memory>
#include <mutex>

#include "text/fonts/handles.hpp"

namespace vtm::text {

/// Keeps the face's bytes. Only one thread at a time may use it: hold `mutex`.
class FreeTypeFace {
public:
    /// Sizes are such that a pixel is a font unit. Null where FreeType cannot read the face.
    static std::shared_ptr<FreeTypeFace> of(hb_face_t* face);

    FreeTypeFace(const FreeTypeFace&) = delete;
    FreeTypeFace& operator=(const FreeTypeFace&) = delete;
    ~FreeTypeFace();

    FT_Face face() const { return face_; }
    std::mutex mutex;

private:
    FreeTypeFace() = default;

    HbBlob bytes_;
    FT_Library library_ = nullptr;
    FT_Face face_ = nullptr;
};

}  // namespace vtm::text
