#include <vtm/font/font_maps.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "asset/place.hpp"
#include "font/glyph_maps.hpp"

namespace vtm::font {

using asset::Asset;
using glm::dvec2;
using text::GlyphId;

// ---- The class --------------------------------------------------------------------------------------

FontMaps::FontMaps(std::span<const std::uint8_t> file, const Options& options)
    : impl_(std::make_unique<Impl>(file, options)) {}
FontMaps::~FontMaps() = default;
FontMaps::FontMaps(FontMaps&&) noexcept = default;
FontMaps& FontMaps::operator=(FontMaps&&) noexcept = default;

std::string FontMaps::family() const { return impl_->font->familyName(); }
double FontMaps::ascent() const { return impl_->font->metrics().ascent / impl_->font->unitsPerEm(); }
double FontMaps::descent() const { return impl_->font->metrics().descent / impl_->font->unitsPerEm(); }

std::optional<double> FontMaps::advanceOf(char32_t character) const {
    const std::optional<GlyphId> glyph = impl_->font->glyphOf(character);
    if (!glyph)
        return std::nullopt;
    return impl_->font->advanceOf(*glyph) / impl_->font->unitsPerEm();
}

std::vector<char32_t> FontMaps::characters() const { return impl_->font->characters(); }

std::u32string FontMaps::addCharacters(std::u32string_view characters) {
    std::u32string missing;
    std::vector<std::pair<GlyphId, char32_t>> found;
    std::vector<GlyphId> ids;
    for (const char32_t character : characters)
        if (const std::optional<GlyphId> glyph = impl_->font->glyphOf(character)) {
            found.emplace_back(*glyph, character);
            ids.push_back(*glyph);
        } else {
            missing += character;
        }
    impl_->add(ids);
    for (const auto& [glyph, character] : found)
        if (GlyphMaps::Glyph& known = impl_->glyphs.at(glyph); known.character == 0)
            known.character = character;
    return missing;
}

void FontMaps::addGlyphs(std::span<const std::uint32_t> glyphs) {
    const text::GlyphId count = impl_->font->glyphCount();
    for (const std::uint32_t glyph : glyphs)
        if (glyph >= count)
            throw std::out_of_range(fmt::format("glyph {}: the font has {}", glyph, count));
    impl_->add(glyphs);
}

std::size_t FontMaps::glyphCount() const { return impl_->glyphs.size(); }

// ---- From and to assets -----------------------------------------------------------------------------

bool FontMaps::take(const asset::AssetView& made) {
    if (!made.font || made.font->key != impl_->key)
        return false;
    for (const asset::Glyph& glyph : made.glyphs)
        impl_->take(made, glyph);
    impl_->compiled.fallbackLeaves += made.fallbackLeaves;
    if (made.fallbackLeaves > 0)
        impl_->compiled.finestPixel = std::max(*impl_->compiled.finestPixel, made.finestPixel.value_or(0));
    return true;
}

namespace {

bool isWithinSquare(dvec2 p) { return p.x >= 0 && p.y >= 0 && p.x < 1 && p.y < 1; }

constexpr std::size_t maxSpecimen = 64;  // glyphs: they take bytes
constexpr double specimenCell = 1.25;    // ems: a square with some room around a letter

/// Where the i-th of `count` glyphs has its origin, ems: in rows of a square.
dvec2 specimenPlace(std::size_t i, std::size_t columns, double ascent, double descent) {
    const dvec2 cell(double(i % columns), double(i / columns));
    return specimenCell * (cell + dvec2(0.15, 0.5)) + dvec2(0, 0.5 * (ascent - descent));
}

/// The first glyphs that are not blank, in rows, as the picture of the asset.
void addSpecimen(Asset& asset) {
    std::vector<const asset::Glyph*> shown;
    for (const asset::Glyph& glyph : asset.glyphs)
        if (glyph.partCount() > 0 && shown.size() < maxSpecimen)
            shown.push_back(&glyph);
    const auto columns = std::max<std::size_t>(1, std::size_t(std::ceil(std::sqrt(double(shown.size())))));
    const double side = specimenCell * double(columns);
    std::vector<asset::PlacementInSquare> placements;
    double stored = 0;
    for (std::size_t i = 0; i < shown.size(); ++i) {
        const dvec2 origin =
            specimenPlace(i, columns, double(asset.font->ascent), double(asset.font->descent));
        for (std::uint32_t p = 0; p < shown[i]->partCount(); ++p) {
            const asset::GlyphPart& part = asset.glyphParts[shown[i]->firstPart() + p];
            const asset::Affine2 toEms = asset::placeOf(asset.maps[part.map]);
            const asset::Affine2 place{toEms.linear / side,
                                       (toEms.offset + origin + dvec2(part.x, part.y)) / side};
            if (!isWithinSquare(place(dvec2(0.5))))
                continue;
            placements.push_back({std::uint16_t(part.map), {0, 1}, place});
            stored = std::max(stored, asset::placementError(place.linear) * side);
        }
    }
    asset.width = asset.height = asset.maps.front().side = side;
    const std::uint32_t trees = asset::appendInstances(placements, asset);
    asset.maps.front().instances = trees;
    asset.finestPixel = *asset.finestPixel + stored / asset::finestShare;
    asset.commands = {asset::Command{}};
}

}  // namespace

Asset FontMaps::asset() const {
    Asset asset = impl_->compiled;
    asset.font = asset::Font{impl_->key, float(ascent()), float(descent())};
    for (const auto& [id, glyph] : impl_->glyphs) {
        const float advance = float(impl_->font->advanceOf(id) / impl_->em());
        const std::uint32_t parts = std::uint32_t(asset.glyphParts.size()) | std::uint32_t(glyph.parts.size())
                                                                                 << 24;
        asset.glyphs.push_back({id, parts, advance, glyph.character});
        asset.glyphParts.insert(asset.glyphParts.end(), glyph.parts.begin(), glyph.parts.end());
    }
    addSpecimen(asset);
    if (asset.glyphs.empty())
        asset.font.reset();
    return asset;
}

}  // namespace vtm::font
