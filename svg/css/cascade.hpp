/// \file
/// Which declarations fall on which element, sorted. Source: CSS Cascade 4 section 6.
#pragma once

#include <string_view>
#include "svg/xml/report.hpp"

namespace vtm::svg {

/// Reads `sheet`, the style sheets in the tree, the style attributes and the presentation attributes, and
/// fills every element's declarations.
void cascade(Tree& tree, std::string_view sheet, Reporter& reporter);

}  // namespace vtm::svg
