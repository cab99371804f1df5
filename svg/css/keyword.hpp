/// \file
/// Keywords of properties and what they stand for.
#pragma once

#include <algorithm>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

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
    if (found == std::end(table))
        return std::nullopt;
    return std::optional<T>(std::in_place, found->value);
}

/// Of properties whose value may be none, as `auto` is: what was read, but nothing where it is invalid. (An
/// optional that is returned as an optional of optionals would hold none.)
template <class T>
std::optional<std::optional<T>> valid(const std::optional<T>& read) {
    if (!read)
        return std::nullopt;
    return std::optional<std::optional<T>>(std::in_place, read);
}

}  // namespace vtm::svg
