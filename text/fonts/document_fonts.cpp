#include "text/fonts/document_fonts.hpp"

#include <fmt/format.h>
#include <hb-ot.h>

#include <utility>

#include "text/fonts/container.hpp"
#include "text/fonts/library.hpp"

namespace vtm::text {
namespace {

/// Those of the font that the rule wants; all for a rule without unicode-range.
HbSet charactersOf(hb_face_t* font, const FontFace& face) {
    HbSet characters(hb_set_create());
    hb_face_collect_unicodes(font, characters.get());
    if (face.characters.empty())
        return characters;
    const HbSet wanted(hb_set_create());
    for (const FontFace::Range& range : face.characters)
        hb_set_add_range(wanted.get(), range.first, range.last);
    hb_set_intersect(characters.get(), wanted.get());
    return characters;
}

std::shared_ptr<FcCharSet> charsetOf(const hb_set_t* characters) {
    std::shared_ptr<FcCharSet> set(FcCharSetCreate(), FcCharSetDestroy);
    for (hb_codepoint_t c = HB_SET_VALUE_INVALID; hb_set_next(characters, &c);)
        FcCharSetAddChar(set.get(), c);
    return set;
}

bool isForSpace(const FontFace& face) {
    for (const FontFace::Range& range : face.characters)
        if (range.first <= U' ' && U' ' <= range.last)
            return true;
    return face.characters.empty();
}

FaceEntry entryOf(const FontFace& face, std::shared_ptr<const Face> font) {
    FaceEntry entry;
    entry.family = face.family;
    entry.minWeight = face.minWeight;
    entry.maxWeight = face.maxWeight;
    entry.minStretch = face.minStretch;
    entry.maxStretch = face.maxStretch;
    entry.slant = face.slant;
    entry.variable = hb_ot_var_has_data(font->harfbuzz());
    entry.color = font->hasColor();
    entry.forSpace = isForSpace(face);
    entry.characters = charsetOf(charactersOf(font->harfbuzz(), face).get());
    entry.ownFace = std::move(font);
    return entry;
}

}  // namespace

void DocumentFonts::add(const FontFace& face, std::span<const std::uint8_t> bytes) {
    const HbBlob sfnt = sfntOf(bytes);
    auto font = openFace(sfnt.get(), 0, face.family);
    if (!font)
        throw FontError("the font has no glyphs");
    if (font->hasTooLargeGlyphs())
        throw FontError(
            fmt::format("a glyph of the font has more than {} points or contains itself", maxGlyphParts));
    entries_.push_back(std::make_unique<const FaceEntry>(entryOf(face, std::move(font))));
    auto& family = families_[familyKey(face.family)];
    family.insert(family.begin(), entries_.back().get());
}

const std::vector<const FaceEntry*>& DocumentFonts::family(const std::string& name) const {
    static const std::vector<const FaceEntry*> none;
    const auto found = families_.find(familyKey(name));
    return found == families_.end() ? none : found->second;
}

}  // namespace vtm::text
