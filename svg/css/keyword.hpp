/// \file
/// Keywords of properties and what they stand for.
#pragma once

#include <algorithm>
#include <iterator>
#include <optional>
#include <string_view>

#include "svg/css/cursor.hpp"

namespace vtm::svg {

/// One row of a keyword table.
template <class T>
struct Keyword {
    std::string_view name;
    T value;
};

template <class T, std::size_t N>
std::optional<T> findKeyword(std::string_view text, const Keyword<T> (&table)[N]) {
    const auto found = std::find_if(std::begin(table), std::end(table), [&](const Keyword<T>& row) {
        return equalsIgnoringCase(row.name, text);
    });
    return found == std::end(table) ? std::nullopt : std::optional(found->value);
}

}  // namespace vtm::svg
