/// \file
/// Text content in, shaped clusters out, chunk by chunk. A chunk begins where a character has an absolute
/// position, and where a path begins or ends (SVG 2 section 11.5). What comes out is fitted to
/// `textLength` and `lengthAdjust` (SVG 2 section 11.5, "Apply the textLength attribute").
#pragma once

#include <glm/vec2.hpp>

#include <vector>

#include "svg/text/content.hpp"
#include "svg/text/element_font.hpp"

namespace vtm::svg {

struct ShapedCluster {
    int element = 0;
    std::size_t first = 0, count = 0;  ///< characters of TextContent
    std::size_t chunk = 0;
    std::vector<text::Glyph> glyphs;
    bool sideways = false;
    double advance = 0;       ///< user units, letter-spacing and word-spacing in it
    double glyphAdvance = 0;  ///< without them
    double trailing = 0;      ///< letter-spacing behind a chunk's last character, not in its advance
    double stretch = 1;       ///< of glyphs along the line
    glm::dvec2 at{0};         ///< the pen, user units; along the path for text on a path
};

/// Chunks in logical order, the clusters of each in visual order.
std::vector<ShapedCluster> shapeChunks(const TextContent& content,
                                       const std::vector<ElementFont>& elementFonts, text::FontSet& fonts,
                                       bool vertical);

/// Moves and stretches clusters on one line so that each element has the length that it asks for; what
/// follows it moves with its end.
void adjustLengths(const TextContent& content, std::vector<ShapedCluster>& clusters, bool vertical);

}  // namespace vtm::svg
