/// \file
/// Reading and writing picture files.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "image/bitmap.hpp"

namespace vtm::image {

/// Says what is wrong with the encoded data or the file.
class CodecError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Limit on decoded pixels: width * height beyond it is an error before anything is allocated.
inline constexpr std::int64_t maxDecodedPixels = 1 << 26;

/// PNG, JPEG, WebP or GIF (first frame), told apart by their signatures.
Bitmap decode(std::span<const std::uint8_t> bytes);

std::vector<std::uint8_t> encodePng(const Bitmap& bitmap);

/// Whole files. Errors name the path.
std::vector<std::uint8_t> readFile(const std::string& path);
void writeFile(const std::string& path, std::span<const std::uint8_t> bytes);

}  // namespace vtm::image
