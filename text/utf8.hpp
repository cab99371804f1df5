/// \file
/// UTF-8 as characters. Source: Unicode 15, section 3.9.
#pragma once

#include <string_view>

namespace vtm::text {

/// Reads one character of text that is not empty, and steps over it. Malformed bytes are U+FFFD, one at a
/// time.
char32_t readCharacter(std::string_view& utf8);

}  // namespace vtm::text
