/// \file
/// The glyphs of a font, compiled as they are asked for: what FontMaps and Typesetter work on.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <tuple>
#include <vector>

#include <vtm/font/font_maps.hpp>
#include "font/parts.hpp"
#include "geometry/box.hpp"
#include "text/font.hpp"
#include "text/font_set.hpp"

namespace vtm::font {

/// A glyph and where it stands beside others: font units, y down.
struct GlyphAt {
    text::GlyphId id = 0;
    glm::dvec2 at{0};

    friend bool operator<(const GlyphAt& a, const GlyphAt& b) {
        return std::tie(a.id, a.at.x, a.at.y) < std::tie(b.id, b.at.x, b.at.y);
    }
};

class GlyphMaps {
public:
    /// Throws FontError, std::invalid_argument.
    GlyphMaps(std::span<const std::uint8_t> file, const Options& options);

    /// Compiles those that are not there yet, several at a time. Throws FontError (more parts than numbers).
    void add(std::span<const text::GlyphId> glyphs);
    const std::vector<asset::GlyphPart>& partsOf(text::GlyphId glyph);
    /// Of the union of several glyphs' outlines.
    const std::vector<asset::GlyphPart>& partsOf(const std::vector<GlyphAt>& glyphs);
    /// What lies within a box, ems, of a glyph's outline.
    const std::vector<asset::GlyphPart>& clippedPartsOf(text::GlyphId glyph, const geometry::Box& box);
    /// The outline in font units; null if it is blank.
    std::shared_ptr<const scene::Path> outlineOf(text::GlyphId glyph) const;
    /// Takes a glyph and its maps from an asset of the same font.
    void take(const asset::AssetView& made, const asset::Glyph& glyph);

    double em() const { return font->unitsPerEm(); }

    const Options options;
    const std::uint64_t key;
    text::FontSet fonts;
    text::FontQuery query;
    std::shared_ptr<const text::Font> font;
    /// maps[0] is the place of the specimen, which FontMaps::asset makes.
    asset::Asset compiled;
    struct Glyph {
        char32_t character = 0;
        std::vector<asset::GlyphPart> parts;
    };
    std::map<text::GlyphId, Glyph> glyphs;

private:
    /// Compiles the parts of several outlines that are not there yet.
    std::vector<std::vector<asset::GlyphPart>> compile(const std::vector<scene::Path>& outlines);
    std::uint32_t append(const asset::AssetView& map);

    std::map<PartKey, std::uint32_t> maps_;  ///< by their outline
    std::map<std::vector<GlyphAt>, std::vector<asset::GlyphPart>> groups_;
    std::map<std::tuple<text::GlyphId, double, double, double, double>, std::vector<asset::GlyphPart>>
        clipped_;
};

struct FontMaps::Impl : GlyphMaps {
    using GlyphMaps::GlyphMaps;
};

}  // namespace vtm::font
