#include "text/fonts/face.hpp"

#include <hb-ot.h>

#include "text/color/color_glyph.hpp"
#include "text/fonts/open_type_font.hpp"

namespace vtm::text {

Face::Face(HbFace face, std::string family)
    : face_(std::move(face)),
      family_(std::move(family)),
      hasColor_(hasColorTables(harfbuzz())),
      composites_(harfbuzz()) {}

bool Face::hasAxis(Tag axis) const {
    hb_ot_var_axis_info_t info;
    return hb_ot_var_find_axis_info(face_.get(), axis, &info);
}

bool Face::isTooLarge(GlyphId glyph) const {
    const std::lock_guard lock(compositesMutex_);
    return composites_.partsOf(glyph) > maxGlyphParts;
}

bool Face::hasTooLargeGlyphs() const {
    for (GlyphId glyph = 0; glyph < hb_face_get_glyph_count(harfbuzz()); ++glyph)
        if (isTooLarge(glyph))
            return true;
    return false;
}

std::shared_ptr<const Font> Face::font(const Instance& instance) const {
    const std::lock_guard lock(mutex_);
    std::weak_ptr<const Font>& known = fonts_[instance];
    std::shared_ptr<const Font> font = known.lock();
    if (!font)
        known = font = std::make_shared<const OpenTypeFont>(shared_from_this(), instance);
    return font;
}

std::shared_ptr<const Face> openFace(hb_blob_t* bytes, unsigned index, std::string family) {
    HbFace face(hb_face_create(bytes, index));
    if (index >= hb_face_count(bytes) || hb_face_get_glyph_count(face.get()) == 0)
        return nullptr;
    hb_face_make_immutable(face.get());
    return std::make_shared<const Face>(std::move(face), std::move(family));
}

std::shared_ptr<const Face> openFace(const std::string& file, unsigned index, const std::string& family) {
    static std::mutex mutex;
    static std::map<std::pair<std::string, unsigned>, std::weak_ptr<const Face>> open;
    const std::lock_guard lock(mutex);
    std::weak_ptr<const Face>& known = open[{file, index}];
    std::shared_ptr<const Face> face = known.lock();
    if (face)
        return face;
    if (const HbBlob bytes{hb_blob_create_from_file_or_fail(file.c_str())})
        face = openFace(bytes.get(), index, family);
    known = face;
    return face;
}

}  // namespace vtm::text
