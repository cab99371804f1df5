/// \file
/// Lines of `text-decoration`. Source: CSS Text Decoration 3 section 2, SVG 2 section 11.10.3.
#pragma once

#include <vector>

#include "svg/text/element_font.hpp"
#include "svg/text/layout.hpp"

namespace vtm::svg {

/// The lines of all clusters. An element's lines go on through the elements in it, at its own place, with its
/// own thickness and paints.
std::vector<PlacedLine> decorationLines(const TextContent& content, const std::vector<ElementFont>& fonts,
                                        const std::vector<PlacedCluster>& clusters, bool vertical);

}  // namespace vtm::svg
