/// \file
/// XML text to the tree of elements.
#pragma once

#include <memory>

#include "svg/xml/element.hpp"
#include "svg/xml/report.hpp"

namespace vtm::svg {

/// Takes the text over (entities already expanded). Throws ParseError if it is not well formed, has
/// no `svg` root or nests deeper than Limits::maxDepth. Declarations are left empty.
std::unique_ptr<Tree> parseXml(std::string text, const SourceMap& map);

}  // namespace vtm::svg
