/// \file
/// A face as its file holds it, before axes are chosen.
#pragma once

#include <hb.h>

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "text/font.hpp"
#include "text/fonts/composites.hpp"
#include "text/fonts/handles.hpp"

namespace vtm::text {

/// What a font is made of besides its face.
struct Instance {
    std::vector<std::pair<Tag, float>> axes;
    bool bold = false, oblique = false;  ///< synthesised
    friend auto operator<=>(const Instance&, const Instance&) = default;
};

/// Shared by all fonts made from it. Immutable for callers and safe to share between threads.
class Face : public std::enable_shared_from_this<Face> {
public:
    Face(HbFace face, std::string family);

    hb_face_t* harfbuzz() const { return face_.get(); }
    const std::string& family() const { return family_; }
    bool hasAxis(Tag axis) const;
    bool hasColor() const { return hasColor_; }  ///< tables that can hold colour glyphs
    /// Of more parts than maxGlyphParts.
    bool isTooLarge(GlyphId glyph) const;
    bool hasTooLargeGlyphs() const;
    /// The same one for the same instance as long as somebody holds it.
    std::shared_ptr<const Font> font(const Instance& instance) const;

private:
    HbFace face_;
    std::string family_;
    bool hasColor_;
    mutable std::mutex mutex_;            ///< guards fonts_
    mutable std::mutex compositesMutex_;  ///< guards composites_
    mutable Composites composites_;
    mutable std::map<Instance, std::weak_ptr<const Font>> fonts_;
};

/// Null where the bytes hold no face of that index with glyphs.
std::shared_ptr<const Face> openFace(hb_blob_t* bytes, unsigned index, std::string family);

/// The file's face, shared by all that hold it; null where the file cannot be used. Thread-safe.
std::shared_ptr<const Face> openFace(const std::string& file, unsigned index, const std::string& family);

}  // namespace vtm::text
