/// \file
/// One line of text in, glyphs in visual order out; and where lines may end. Source: UAX 9 (order), UAX 14
/// (line breaks), UAX 24 (scripts), UAX 29 (clusters), UAX 50 (orientation), CSS Fonts 4 section 5.2 (fonts
/// by cluster).
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "text/font_set.hpp"

namespace vtm::text {

struct Feature {
    Tag tag;
    std::uint32_t value;
    friend bool operator==(const Feature&, const Feature&) = default;
};

enum class TextOrientation { Mixed, Upright, Sideways };

/// Characters of one style.
struct Span {
    std::size_t end;  ///< index after its last character
    FontQuery font;
    std::vector<Feature> features;
    std::string language;
    TextOrientation orientation = TextOrientation::Mixed;  ///< in vertical lines
};

/// A line. Explicit embeddings and overrides are control characters in the text.
struct Line {
    std::u32string text;
    std::vector<Span> spans;                 ///< in order; the last ends with the text
    std::u32string before = {}, after = {};  ///< what stands next to the line: its outer letters join with it
    bool rightToLeft = false;
    bool vertical = false;
};

/// Lengths are in ems of the glyph's font; y points down.
struct Glyph {
    std::shared_ptr<const Font> font;
    GlyphId id = 0;
    double x = 0, y = 0;  ///< from the cluster's pen position to the glyph's origin
    double advance = 0;   ///< along the line
};

/// Glyphs that belong together: a character with its marks, a ligature, an Indic syllable.
struct Cluster {
    std::size_t first = 0, count = 0;  ///< characters of the text, count > 0
    std::vector<Glyph> glyphs;         ///< may be empty
    double advance = 0;                ///< along the line, ems: the sum of its glyphs'
    std::uint8_t level = 0;            ///< bidi embedding level; odd: right to left
    bool sideways = false;             ///< in a vertical line: turned 90° clockwise
    bool cursive = false;              ///< of a script whose letters join, which letter-spacing would tear
};

/// A combining mark or a joiner, which belongs to the character before it.
bool isMark(char32_t character);

/// Clusters from the line's visual start to its end; together they hold every character once. Characters
/// without a glyph in any font are the primary font's .notdef.
std::vector<Cluster> shape(const Line& line, FontSet& fonts);

/// Whether any script or language of the font's table `GSUB` has the feature.
bool hasFeature(const Font& font, Tag feature);

/// For every character whether a line may end behind it. `language`: BCP 47.
std::vector<bool> lineBreaks(const std::u32string& text, const std::string& language);

}  // namespace vtm::text
