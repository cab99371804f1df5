/// \file
/// Owners of what HarfBuzz and fontconfig count by reference.
#pragma once

#include <fontconfig/fontconfig.h>
#include <hb.h>

#include <memory>
#include <string>

namespace vtm::text {

template <auto release>
struct Release {
    template <typename T>
    void operator()(T* owned) const {
        release(owned);
    }
};

using HbBlob = std::unique_ptr<hb_blob_t, Release<hb_blob_destroy>>;
using HbFace = std::unique_ptr<hb_face_t, Release<hb_face_destroy>>;
using HbFont = std::unique_ptr<hb_font_t, Release<hb_font_destroy>>;
using HbSet = std::unique_ptr<hb_set_t, Release<hb_set_destroy>>;
using FcConfiguration = std::unique_ptr<FcConfig, Release<FcConfigDestroy>>;
using FcPatternOwner = std::unique_ptr<FcPattern, Release<FcPatternDestroy>>;
using FcFontSetOwner = std::unique_ptr<FcFontSet, Release<FcFontSetSortDestroy>>;

inline const FcChar8* fcString(const std::string& text) {
    return reinterpret_cast<const FcChar8*>(text.c_str());
}

}  // namespace vtm::text
