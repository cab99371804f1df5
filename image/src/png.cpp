#include <png.h>

#include <algorithm>
#include <array>

#include <vtm/image/codec.hpp>
#include "image/src/formats.hpp"

namespace vtm::image {
namespace {

/// libpng's simplified interface, freed on every way out.
struct PngImage {
    png_image image{};

    PngImage() { image.version = PNG_IMAGE_VERSION; }
    PngImage(const PngImage&) = delete;
    PngImage& operator=(const PngImage&) = delete;
    ~PngImage() { png_image_free(&image); }

    void require(int success) const {
        if (!success)
            throw CodecError(std::string("PNG: ") + image.message);
    }
};

}  // namespace

bool isPng(Bytes bytes) {
    constexpr std::array<std::uint8_t, 8> signature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    return bytes.size() >= signature.size() && std::equal(signature.begin(), signature.end(), bytes.begin());
}

Bitmap decodePng(Bytes bytes) {
    PngImage png;
    png.require(png_image_begin_read_from_memory(&png.image, bytes.data(), bytes.size()));
    png.image.format = PNG_FORMAT_RGBA;
    Bitmap bitmap = makeBitmap(png.image.width, png.image.height);
    png.require(png_image_finish_read(&png.image, nullptr, bitmap.rgba.data(), 0, nullptr));
    return bitmap;
}

}  // namespace vtm::image
