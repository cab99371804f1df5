/// \file
/// From a file's bytes to XML text: UTF-8, entities replaced.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "svg/xml/report.hpp"

namespace vtm::svg {

/// What is no character of Unicode is U+FFFD.
void appendUtf8(std::string& out, char32_t c);

/// Unpacks gzip and converts UTF-16 (by its byte order mark or first character) and what the XML declaration
/// names, as far as the system knows it, to UTF-8. Throws ParseError beyond Limits::maxBytes.
std::string decodeText(std::span<const std::uint8_t> bytes, const std::string& fileName);

/// Text with the internal entities of its DOCTYPE replaced, outside comments and CDATA; the map says
/// where each part comes from. Throws ParseError where the expansion exceeds its limits.
std::string expandEntities(std::string text, SourceMap& map);

}  // namespace vtm::svg
