/// \file
/// From a file's bytes to XML text: UTF-8, entities replaced.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "svg/xml/report.hpp"

namespace vtm::svg {

/// Unpacks gzip and converts UTF-16 (by its byte order mark) and the single-byte encodings of Western
/// Europe (by the XML declaration) to UTF-8. Throws ParseError beyond Limits::maxBytes.
std::string decodeText(std::span<const std::uint8_t> bytes, const std::string& fileName);

/// Text with the internal entities of its DOCTYPE replaced, outside comments and CDATA; the map says
/// where each part comes from. Throws ParseError where the expansion exceeds its limits.
std::string expandEntities(std::string text, SourceMap& map);

}  // namespace vtm::svg
