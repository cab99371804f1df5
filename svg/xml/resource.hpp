/// \file
/// What a document refers to: files and `data:` URLs (RFC 2397).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vtm::svg {

bool isDataUrl(std::string_view href);
/// Throws image::CodecError where it is malformed.
std::vector<std::uint8_t> decodeDataUrl(std::string_view href);
/// Invalid escapes stay as they are.
std::string percentDecoded(std::string_view text);

/// `data:TYPE;base64,…`
std::string dataUrl(std::string_view type, std::span<const std::uint8_t> bytes);

/// The bytes of a `data:` URL, or of a relative reference from `directory`. Absolute paths and other schemes
/// are not read, nor, unless `root` is empty, what lies outside of that folder once `..` and symbolic links
/// are followed. Throws image::CodecError.
std::vector<std::uint8_t> readResource(std::string_view href, const std::string& directory,
                                       const std::string& root = {});

}  // namespace vtm::svg
