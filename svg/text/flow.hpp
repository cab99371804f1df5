/// \file
/// Text that is broken into lines: `inline-size` (SVG 2 section 11.7) and Inkscape's `flowRoot`.
#pragma once

#include <limits>
#include <vector>

#include "svg/text/content.hpp"

namespace vtm::svg {

/// Characters up to the next paragraph; it may have none.
struct Paragraph {
    std::size_t first;  ///< of TextContent
    int element;        ///< whose font an empty one has
};

struct FlowArea {
    double x = 0;      ///< where the lines are anchored, by text-anchor
    double top = 0;    ///< of the first line
    double width = 0;  ///< of lines, where they can be broken
    double bottom = std::numeric_limits<double>::infinity();  ///< lines that end below are left out
};

/// Gives the first character of every line its position, and takes out the spaces at the ends of lines and
/// what does not fit. Horizontal text.
void flow(TextContent& content, const std::vector<Paragraph>& paragraphs, const FlowArea& area,
          text::FontSet& fonts);

/// The height of the text's first line above its baseline, half of the space between lines in it.
double firstAscent(const TextContent& content, text::FontSet& fonts);

}  // namespace vtm::svg
