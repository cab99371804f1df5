/// \file
/// Attributes whose values cannot be read. Conversion takes them for absent, as SVG 2 section 4.2 asks; here
/// they are found and named.
#pragma once

#include "svg/xml/element.hpp"
#include "svg/xml/report.hpp"

namespace vtm::svg {

/// Warns of every attribute of an SVG element that this importer knows, and whose value is none of the
/// attribute's. Presentation attributes are left to the cascade, `d` and `points` to the shapes.
void checkAttributes(const Tree& tree, Reporter& reporter);

}  // namespace vtm::svg
