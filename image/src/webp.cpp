#include <webp/decode.h>

#include <algorithm>
#include <string_view>

#include <vtm/image/codec.hpp>
#include "image/src/decoders.hpp"

namespace vtm::image {

bool isWebp(Bytes bytes) {
    constexpr std::string_view riff = "RIFF", webp = "WEBP";
    return bytes.size() >= 12 && std::equal(riff.begin(), riff.end(), bytes.begin()) &&
           std::equal(webp.begin(), webp.end(), bytes.begin() + 8);
}

Bitmap decodeWebp(Bytes bytes) {
    int width = 0, height = 0;
    if (!WebPGetInfo(bytes.data(), bytes.size(), &width, &height))
        throw CodecError("WebP: the header is broken");
    Bitmap bitmap = makeBitmap(width, height);
    if (!WebPDecodeRGBAInto(bytes.data(), bytes.size(), bitmap.rgba.data(), bitmap.rgba.size(), width * 4))
        throw CodecError("WebP: the data is broken");
    return bitmap;
}

}  // namespace vtm::image
