/// \file
/// One decoder a format. Each throws CodecError and checks the size before it allocates.
#pragma once

#include <cstdint>
#include <span>

#include <vtm/image/bitmap.hpp>

namespace vtm::image {

using Bytes = std::span<const std::uint8_t>;

/// An empty bitmap of that size. Throws CodecError for sizes below 1 or beyond maxDecodedPixels.
Bitmap makeBitmap(std::int64_t width, std::int64_t height);

bool isPng(Bytes bytes);
bool isJpeg(Bytes bytes);
bool isWebp(Bytes bytes);
bool isGif(Bytes bytes);

Bitmap decodePng(Bytes bytes);
Bitmap decodeJpeg(Bytes bytes);
Bitmap decodeWebp(Bytes bytes);
Bitmap decodeGif(Bytes bytes);

}  // namespace vtm::image
