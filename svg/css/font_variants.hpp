/// \file
/// The keywords of `font-variant` and the OpenType features that they switch. Source: CSS Fonts 4 section 6.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "text/shape.hpp"

namespace vtm::svg {

enum class VariantGroup { Ligatures, Caps, Position, Numeric, EastAsian };

/// A set of keywords, bit N for row N of the table.
using FontVariants = std::uint64_t;

/// The keywords of one longhand property, `normal` or `none` too; nothing if one is not the group's.
std::optional<FontVariants> parseVariants(std::string_view text, VariantGroup group);
/// Those of the shorthand `font-variant`.
std::optional<FontVariants> parseVariants(std::string_view text);
/// All keywords of a group.
FontVariants variantsOf(VariantGroup group);
/// The features that the keywords switch on or off.
std::vector<text::Feature> featuresOf(FontVariants variants);

/// Four letters as a tag, first in the highest byte.
constexpr text::Tag fontTag(std::string_view letters) {
    text::Tag tag = 0;
    for (const char letter : letters)
        tag = tag << 8 | static_cast<unsigned char>(letter);
    return tag;
}

}  // namespace vtm::svg
