#include "text/fonts/document_fonts.hpp"

#include <fmt/format.h>
#include <hb-ot.h>
#include <woff2/decode.h>
#include <zlib.h>

#include <algorithm>
#include <string>
#include <utility>

#include <vtm/limits/limits.hpp>
#include "text/font_set.hpp"
#include "text/fonts/library.hpp"

namespace vtm::text {
namespace {

using Bytes = std::span<const std::uint8_t>;

std::uint32_t numberAt(Bytes bytes, std::size_t at, int size) {
    std::uint32_t value = 0;
    for (int i = 0; i < size; ++i)
        value = value << 8 | bytes[at + std::size_t(i)];
    return value;
}

void put(std::string& out, std::size_t at, std::uint32_t value, int size) {
    for (int i = 0; i < size; ++i)
        out[at + std::size_t(i)] = char(value >> (8 * (size - 1 - i)));
}

HbBlob blobOf(const void* bytes, std::size_t size) {
    return HbBlob(hb_blob_create(static_cast<const char*>(bytes), unsigned(size), HB_MEMORY_MODE_DUPLICATE,
                                 nullptr, nullptr));
}

constexpr std::size_t sfntHeader = 12, sfntEntry = 16, woffHeader = 44, woffEntry = 20;

/// An entry of WOFF's table directory, section 5.
struct WoffTable {
    std::uint32_t tag, offset, compressed, size, checksum;
};

std::vector<WoffTable> woffTables(Bytes woff) {
    if (woff.size() < woffHeader)
        throw FontError("WOFF ends in its header");
    const std::size_t count = numberAt(woff, 12, 2);
    if (woff.size() < woffHeader + count * woffEntry)
        throw FontError("WOFF ends in its table directory");
    std::vector<WoffTable> tables;
    for (std::size_t i = 0; i < count; ++i) {
        const auto field = [&](std::size_t n) {
            return numberAt(woff, woffHeader + i * woffEntry + 4 * n, 4);
        };
        tables.push_back({field(0), field(1), field(2), field(3), field(4)});
    }
    return tables;
}

std::size_t padded(std::size_t size) { return (size + 3) / 4 * 4; }

std::size_t sfntSize(const std::vector<WoffTable>& tables) {
    std::size_t size = sfntHeader + tables.size() * sfntEntry;
    for (const WoffTable& table : tables)
        size += padded(table.size);
    if (size > maxFontBytes)
        throw FontError(fmt::format("WOFF holds {} bytes, more than the limit of {}", size, maxFontBytes));
    return size;
}

void inflateTable(Bytes woff, const WoffTable& table, char* to) {
    if (table.compressed > table.size || std::uint64_t(table.offset) + table.compressed > woff.size())
        throw FontError("a table of WOFF lies outside the file");
    const Bytes stored = woff.subspan(table.offset, table.compressed);
    if (table.compressed == table.size) {
        std::copy(stored.begin(), stored.end(), to);
        return;
    }
    uLongf size = table.size;
    if (uncompress(reinterpret_cast<Bytef*>(to), &size, stored.data(), stored.size()) != Z_OK ||
        size != table.size)
        throw FontError("a table of WOFF cannot be decompressed");
}

HbBlob sfntOfWoff(Bytes woff) {
    const std::vector<WoffTable> tables = woffTables(woff);
    const std::size_t size = sfntSize(tables);
    limits::need(size);
    std::string sfnt(size, '\0');
    put(sfnt, 0, numberAt(woff, 4, 4), 4);
    put(sfnt, 4, std::uint32_t(tables.size()), 2);
    std::size_t offset = sfntHeader + tables.size() * sfntEntry;
    for (std::size_t i = 0; i < tables.size(); ++i) {
        const std::size_t entry = sfntHeader + i * sfntEntry;
        put(sfnt, entry, tables[i].tag, 4);
        put(sfnt, entry + 4, tables[i].checksum, 4);
        put(sfnt, entry + 8, std::uint32_t(offset), 4);
        put(sfnt, entry + 12, tables[i].size, 4);
        inflateTable(woff, tables[i], sfnt.data() + offset);
        offset += padded(tables[i].size);
    }
    return blobOf(sfnt.data(), sfnt.size());
}

HbBlob sfntOfWoff2(Bytes woff) {
    std::string sfnt;
    woff2::WOFF2StringOut out(&sfnt);
    out.SetMaxSize(maxFontBytes);
    const std::size_t announced = woff2::ComputeWOFF2FinalSize(woff.data(), woff.size());
    if (announced > maxFontBytes)
        throw FontError(
            fmt::format("WOFF2 holds {} bytes, more than the limit of {}", announced, maxFontBytes));
    limits::need(announced);
    if (!woff2::ConvertWOFF2ToTTF(woff.data(), woff.size(), &out))
        throw FontError("WOFF2 cannot be decompressed");
    return blobOf(sfnt.data(), std::min(sfnt.size(), out.Size()));
}

}  // namespace

HbBlob sfntOf(std::span<const std::uint8_t> bytes) {
    constexpr std::uint32_t trueType = 0x00010000;
    switch (bytes.size() < 4 ? 0 : numberAt(bytes, 0, 4)) {
        case HB_TAG('w', 'O', 'F', 'F'):
            return sfntOfWoff(bytes);
        case HB_TAG('w', 'O', 'F', '2'):
            return sfntOfWoff2(bytes);
        case trueType:
        case HB_TAG('t', 'r', 'u', 'e'):
        case HB_TAG('O', 'T', 'T', 'O'):
        case HB_TAG('t', 't', 'c', 'f'):
            return blobOf(bytes.data(), bytes.size());
        default:
            throw FontError("neither OpenType nor WOFF");
    }
}

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
    auto font = openFace(sfnt.get(), face.index, face.family);
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
