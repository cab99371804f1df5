#include <vtm/image/codec.hpp>

#include <vtm/limits/limits.hpp>
#include "image/src/formats.hpp"

namespace vtm::image {

Bitmap makeBitmap(std::int64_t width, std::int64_t height) {
    if (width < 1 || height < 1)
        throw CodecError("the picture has no pixels");
    if (width > maxDecodedPixels || height > maxDecodedPixels || width * height > maxDecodedPixels)
        throw CodecError("the picture is larger than " + std::to_string(maxDecodedPixels / 1'000'000) +
                         " million pixels");
    limits::need(static_cast<std::size_t>(width * height) * 4);
    return {static_cast<int>(width), static_cast<int>(height),
            std::vector<std::uint8_t>(static_cast<std::size_t>(width * height) * 4)};
}

Bitmap decode(std::span<const std::uint8_t> bytes) {
    if (isPng(bytes))
        return decodePng(bytes);
    if (isJpeg(bytes))
        return decodeJpeg(bytes);
    if (isWebp(bytes))
        return decodeWebp(bytes);
    if (isGif(bytes))
        return decodeGif(bytes);
    if (isAvif(bytes))
        return decodeAvif(bytes);
    throw CodecError("neither a PNG, JPEG, WebP, GIF nor AVIF picture");
}

}  // namespace vtm::image
