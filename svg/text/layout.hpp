/// \file
/// Text content in, glyphs at their places out. Source: SVG 2 section 11.5 (the layout algorithm).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "svg/text/content.hpp"

namespace vtm::svg {

struct PlacedGlyph {
    std::shared_ptr<const text::Font> font;
    text::GlyphId id;
    scene::Affine transform;    ///< font units to user space
    std::size_t character = 0;  ///< of TextContent: the first of its cluster
};

/// A typographic character.
struct PlacedCluster {
    int element = 0;                   ///< of TextContent
    std::size_t first = 0, count = 0;  ///< characters of TextContent
    std::vector<PlacedGlyph> glyphs;
    scene::Affine frame = scene::identity;  ///< from the pen at the origin, the line along x, to user space
    Box cell;                               ///< in that frame: the advance by the font's ascent and descent
};

/// A line of `text-decoration` under, over or through adjoining clusters.
struct PlacedLine {
    std::size_t element = 0;  ///< whose line it is, with its paints
    TextLines line = Underline;
    scene::Path outline;  ///< user space
};

struct TextLayout {
    std::vector<PlacedCluster> clusters;  ///< in painting order
    std::vector<PlacedLine> lines;
};

TextLayout layOut(const TextContent& content, text::FontSet& fonts);

}  // namespace vtm::svg
