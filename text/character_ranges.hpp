/// \file
/// Sets of characters, as Unicode's tables have them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace vtm::text {

/// `last` is in it.
struct CharacterRange {
    char32_t first, last;
};

/// Whether one of the ranges, which ascend, has the character.
template <std::size_t n>
bool contains(const CharacterRange (&ranges)[n], char32_t character) {
    const auto after = std::ranges::upper_bound(ranges, character, {}, &CharacterRange::first);
    return after != std::begin(ranges) && character <= std::prev(after)->last;
}

}  // namespace vtm::text
