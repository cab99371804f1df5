/// \file
/// A font: one face of a font file at chosen variation axes. Its glyphs' outlines and metrics.
/// Source: OpenType 1.9.
///
/// All lengths are in font units, unitsPerEm() of them an em; y points down, as in scenes, and the origin is
/// the start of the glyph's baseline.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <vtm/scene/scene.hpp>

struct hb_font_t;

namespace vtm::text {

using GlyphId = std::uint32_t;

/// An axis or a feature: four letters, first in the highest byte, as in OpenType.
using Tag = std::uint32_t;

struct FontMetrics {
    double ascent, descent;                      ///< above and below the baseline, both positive as a rule
    double xHeight, capHeight;                   ///< above the baseline; estimated where the font is silent
    double underlineOffset, underlineThickness;  ///< middle of the line, below the baseline positive
    double strikeoutOffset, strikeoutThickness;  ///< middle of the line, above the baseline positive
    double subscriptOffset, superscriptOffset;   ///< below and above the baseline, both positive as a rule
};

/// A colour glyph that is an SVG document (OpenType's `SVG ` table): the element of id `glyphN` for glyph N,
/// in font units, y down.
struct SvgGlyph {
    std::vector<std::uint8_t> document;  ///< perhaps gzip-compressed
};

/// Immutable for callers and safe to share between threads. Owns the file's bytes.
class Font {
public:
    virtual ~Font() = default;

    virtual const std::string& family() const = 0;  ///< as the file spells it
    virtual double unitsPerEm() const = 0;
    virtual const FontMetrics& metrics() const = 0;
    virtual std::string familyName() const = 0;  ///< in the font itself; may be empty
    virtual GlyphId glyphCount() const = 0;
    virtual std::vector<char32_t> characters() const = 0;  ///< that have glyphs, ascending

    /// Nothing where the font has no glyph for the character; 0 selects no variation.
    virtual std::optional<GlyphId> glyphOf(char32_t character, char32_t variationSelector = 0) const = 0;
    /// The advance along a horizontal line.
    virtual double advanceOf(GlyphId glyph) const = 0;

    /// The same path every time it is asked for; null for blank and broken glyphs. NonZero filled.
    virtual std::shared_ptr<const scene::Path> outlineOf(GlyphId glyph) const = 0;
    /// A glyph that brings its own colours: a group of items, or an SVG document. Nothing for others.
    /// `foreground` stands for the colour of the text; `transform` maps font units to the group's picture.
    using ColorGlyph = std::variant<scene::Group, SvgGlyph>;
    virtual std::optional<ColorGlyph> colorGlyphOf(
        GlyphId glyph, const scene::Color& foreground,
        const scene::Affine& transform = scene::identity) const = 0;

    /// HarfBuzz's numbers are integers: so many to a font unit, so that variations keep a 64th.
    static constexpr int harfbuzzScale = 64;
    /// For shaping. y up.
    virtual hb_font_t* harfbuzz() const = 0;

protected:
    Font() = default;
    Font(const Font&) = delete;
    Font& operator=(const Font&) = delete;
};

}  // namespace vtm::text
