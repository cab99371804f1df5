/// \file
/// Names of axes and features. Source: OpenType 1.9.
#pragma once

#include <stdexcept>
#include <string>

#include "text/font.hpp"

namespace vtm::font {

/// Throws std::invalid_argument unless the name has four characters.
inline text::Tag tagOf(const std::string& name) {
    if (name.size() != 4)
        throw std::invalid_argument("font: '" + name + "' is not a name of four characters");
    text::Tag tag = 0;
    for (const char c : name)
        tag = tag << 8 | static_cast<unsigned char>(c);
    return tag;
}

}  // namespace vtm::font
