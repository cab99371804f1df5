/// \file
/// Bytes as text for a page: docs/view.md describes the encoding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vtm::web {

/// Exclusive or with `base` as far as both go: of what nearly equals another chunk nearly nothing is left.
std::vector<std::uint8_t> difference(std::span<const std::uint8_t> bytes, std::span<const std::uint8_t> base);

/// zlib's format, as small as zlib makes it.
std::vector<std::uint8_t> deflated(std::span<const std::uint8_t> bytes);

/// "3af0": bytes. Needs an even number of digits in lower case.
std::vector<std::uint8_t> fromHexadecimal(std::string_view digits);

/// Text in an HTML element or in an attribute in quotes.
std::string escaped(std::string_view text);

}  // namespace vtm::web
