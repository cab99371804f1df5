/// \file
/// Where lines of text may end. Source: UAX 14.
#pragma once

#include <string>
#include <vector>

namespace vtm::text {

/// For every character whether a line may end behind it. `language`: BCP 47.
std::vector<bool> lineBreaks(const std::u32string& text, const std::string& language);

}  // namespace vtm::text
