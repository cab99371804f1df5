/// \file
/// One decoder and one encoder a format.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include <vtm/image/bitmap.hpp>
#include <vtm/image/encode.hpp>

namespace vtm::image {

using Bytes = std::span<const std::uint8_t>;

/// An empty bitmap of that size. Throws CodecError for sizes below 1 or beyond maxDecodedPixels.
Bitmap makeBitmap(std::int64_t width, std::int64_t height);

bool isPng(Bytes bytes);
bool isJpeg(Bytes bytes);
bool isWebp(Bytes bytes);
bool isGif(Bytes bytes);
bool isAvif(Bytes bytes);

/// Each throws CodecError, and checks the size before it allocates.
Bitmap decodePng(Bytes bytes);
Bitmap decodeJpeg(Bytes bytes);
Bitmap decodeWebp(Bytes bytes);
Bitmap decodeGif(Bytes bytes);
Bitmap decodeAvif(Bytes bytes);

/// Of sizes and options that makeEncoder() has checked.
std::unique_ptr<Encoder> makePngEncoder(int width, int height, int depth);
std::unique_ptr<Encoder> makeJpegEncoder(int width, int height, int quality);
/// Without a quality every pixel is kept.
std::unique_ptr<Encoder> makeWebpEncoder(int width, int height, std::optional<int> quality);

}  // namespace vtm::image
