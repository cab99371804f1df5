#include "text/fonts/composites.hpp"

#include <hb-ot.h>

#include <algorithm>
#include <limits>

#include "text/fonts/table_cursor.hpp"

namespace vtm::text {
namespace {

constexpr std::uint32_t tooMany = maxGlyphParts + 1, unknown = std::numeric_limits<std::uint32_t>::max();

/// As HarfBuzz's; deeper ones have no outline.
constexpr int maxDepth = 64;

// Flags of a component.
constexpr std::uint32_t wordArguments = 1, hasScale = 8, moreComponents = 0x20, hasTwoScales = 0x40,
                        hasMatrix = 0x80;

std::size_t argumentBytes(std::uint32_t flags) {
    const std::size_t places = flags & wordArguments ? 4 : 2;
    return places + (flags & hasScale ? 2 : flags & hasTwoScales ? 4 : flags & hasMatrix ? 8 : 0);
}

bool hasLongOffsets(hb_face_t* face) {
    const HbBlob head(hb_face_reference_table(face, HB_TAG('h', 'e', 'a', 'd')));
    constexpr std::size_t indexToLocFormat = 50;
    return TableCursor(bytesOf(head.get()), indexToLocFormat).unsignedNumber(2) != 0;
}

}  // namespace

Composites::Composites(hb_face_t* face)
    : glyf_(hb_face_reference_table(face, HB_TAG('g', 'l', 'y', 'f'))),
      loca_(hb_face_reference_table(face, HB_TAG('l', 'o', 'c', 'a'))),
      glyfBytes_(bytesOf(glyf_.get())),
      locaBytes_(bytesOf(loca_.get())),
      longOffsets_(hasLongOffsets(face)),
      parts_(glyfBytes_.empty() ? 0 : hb_face_get_glyph_count(face), unknown) {}

std::uint32_t Composites::partsOf(std::uint32_t glyph) { return count(glyph, 0); }

std::uint32_t Composites::count(std::uint32_t glyph, int depth) {
    if (glyph >= parts_.size())
        return 0;
    if (parts_[glyph] != unknown)
        return parts_[glyph];
    if (depth == maxDepth)
        return tooMany;
    parts_[glyph] = tooMany;  // of one that contains itself
    const int size = longOffsets_ ? 4 : 2;
    const std::size_t offset =
        TableCursor(locaBytes_, std::size_t(glyph) * size_t(size)).unsignedNumber(size);
    const std::size_t at = longOffsets_ ? offset : 2 * offset;
    constexpr std::size_t header = 10;
    const int contours = TableCursor(glyfBytes_, at).word();
    if (contours < 0)
        return parts_[glyph] = countComponents(at + header, depth);
    const std::size_t lastPoint = at + header + 2 * std::size_t(std::max(contours, 1) - 1);
    return parts_[glyph] = contours == 0 ? 0 : TableCursor(glyfBytes_, lastPoint).unsignedNumber(2) + 1;
}

std::uint32_t Composites::countComponents(std::size_t at, int depth) {
    std::uint32_t parts = 0, flags = moreComponents;
    while (flags & moreComponents && parts < tooMany && at < glyfBytes_.size()) {
        TableCursor component(glyfBytes_, at);
        flags = component.unsignedNumber(2);
        parts += 1 + count(component.unsignedNumber(2), depth + 1);
        at += 4 + argumentBytes(flags);
    }
    return std::min(parts, tooMany);
}

}  // namespace vtm::text
