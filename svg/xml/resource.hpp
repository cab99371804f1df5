/// \file
/// What a document refers to: files and `data:` URLs.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace vtm::svg {

/// The bytes of a `data:` URL, or of a relative reference below `directory`. Absolute paths and other schemes
/// are not read. Throws image::CodecError.
std::vector<std::uint8_t> readResource(std::string_view href, const std::string& directory);

}  // namespace vtm::svg
