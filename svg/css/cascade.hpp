/// \file
/// Which declarations fall on which element, sorted. Source: CSS Cascade 4 section 6.
#pragma once

#include "svg/xml/report.hpp"

namespace vtm::svg {

/// Reads options.styleSheet, the style sheets in the tree and those that they import, the style attributes
/// and the presentation attributes, and fills every element's declarations.
void cascade(Tree& tree, const Options& options, Reporter& reporter);

}  // namespace vtm::svg
