/// \file
/// `textLength` and `lengthAdjust`. Source: SVG 2 section 11.5, "Apply the textLength attribute".
#pragma once

#include <vector>

#include "svg/text/chunks.hpp"
#include "svg/text/content.hpp"

namespace vtm::svg {

/// Moves and stretches clusters on one line so that each element has the length that it asks for; what
/// follows it moves with its end.
void adjustLengths(const TextContent& content, std::vector<ShapedCluster>& clusters, bool vertical);

}  // namespace vtm::svg
