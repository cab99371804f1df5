#include <png.h>

#include <csetjmp>
#include <cstring>
#include <stdexcept>

#include <vtm/image/codec.hpp>
#include "conformance/compare/compare.hpp"

namespace vtm::compare {
namespace {

struct Decoded {
    int width = 0, height = 0;
    bool deep = false;      ///< two bytes a channel, big-endian
    bool straight = false;  ///< a deep one that says so
    std::vector<std::uint8_t> rgba;
};

/// libpng's view of a picture that is being read. The error hook must not return: it jumps.
struct Reader {
    std::span<const std::uint8_t> rest;  ///< not read yet
    png_structp png = nullptr;
    png_infop info = nullptr;
    std::string error;

    Reader() {
        png = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, fail, ignoreWarning);
        info = png ? png_create_info_struct(png) : nullptr;
    }
    ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    static void fail(png_structp png, png_const_charp message) {
        static_cast<Reader*>(png_get_error_ptr(png))->error = message;
        png_longjmp(png, 1);
    }
    static void ignoreWarning(png_structp, png_const_charp) {}
    static void take(png_structp png, png_bytep to, std::size_t count) {
        auto& rest = static_cast<Reader*>(png_get_io_ptr(png))->rest;
        if (rest.size() < count)
            png_error(png, "the file ends too early");
        std::memcpy(to, rest.data(), count);
        rest = rest.subspan(count);
    }
};

/// Asks libpng to turn every colour type of up to 8 bits into RGBA.
void expandToRgba(Reader& reader) {
    png_set_expand(reader.png);
    png_set_gray_to_rgb(reader.png);
    png_set_add_alpha(reader.png, 0xff, PNG_FILLER_AFTER);
    png_set_interlace_handling(reader.png);
    png_read_update_info(reader.png, reader.info);
}

/// As our encoder marks its files (image/src/png.cpp).
bool saysStraight(const Reader& reader) {
    png_textp texts = nullptr;
    const int count = png_get_text(reader.png, reader.info, &texts, nullptr);
    for (int i = 0; i < count; ++i)
        if (std::strcmp(texts[i].key, "Alpha") == 0 && std::strcmp(texts[i].text, "straight") == 0)
            return true;
    return false;
}

void readHeader(Reader& reader, Decoded& picture) {
    png_read_info(reader.png, reader.info);
    picture.width = int(png_get_image_width(reader.png, reader.info));
    picture.height = int(png_get_image_height(reader.png, reader.info));
    picture.deep = png_get_bit_depth(reader.png, reader.info) == 16;
    picture.straight = picture.deep && saysStraight(reader);
    if (picture.deep && png_get_color_type(reader.png, reader.info) != PNG_COLOR_TYPE_RGB_ALPHA)
        png_error(reader.png, "16-bit picture is not RGBA");
    if (std::int64_t(picture.width) * picture.height > image::maxDecodedPixels)
        png_error(reader.png, "picture too large");
}

void readRows(Reader& reader, Decoded& picture) {
    const std::size_t stride = png_get_rowbytes(reader.png, reader.info);
    picture.rgba.resize(stride * std::size_t(picture.height));
    const int passes = png_set_interlace_handling(reader.png);
    for (int pass = 0; pass < passes; ++pass)
        for (int y = 0; y < picture.height; ++y)
            png_read_row(reader.png, &picture.rgba[stride * std::size_t(y)], nullptr);
    png_read_end(reader.png, nullptr);
}

/// Fills `picture`; false with `reader.error` set otherwise. Holds no object with a destructor, since
/// libpng jumps out of it.
bool read(Reader& reader, Decoded& picture) {
    if (setjmp(png_jmpbuf(reader.png)) != 0)
        return false;
    png_set_read_fn(reader.png, &reader, Reader::take);
    readHeader(reader, picture);
    expandToRgba(reader);
    readRows(reader, picture);
    return true;
}

Decoded decode(std::span<const std::uint8_t> bytes, const std::string& name) {
    Reader reader;
    if (!reader.info)
        throw std::runtime_error(name + ": libpng cannot start");
    reader.rest = bytes;
    Decoded picture;
    if (!read(reader, picture))
        throw std::runtime_error(name + ": " + reader.error);
    return picture;
}

image::Raster fromSixteenBits(const Decoded& picture) {
    image::Raster raster(picture.width, picture.height);
    for (std::size_t i = 0; i < raster.rgba.size(); ++i)
        raster.rgba[i] = float((picture.rgba[2 * i] << 8 | picture.rgba[2 * i + 1]) / 65535.0);
    for (std::size_t i = 0; picture.straight && i < raster.rgba.size(); i += 4)
        for (std::size_t c = 0; c < 3; ++c)
            raster.rgba[i + c] *= raster.rgba[i + 3];
    return raster;
}

}  // namespace

image::Raster readPng(const std::string& path) { return readPng(image::readFile(path), path); }

image::Raster readPng(std::span<const std::uint8_t> bytes, const std::string& name) {
    Decoded picture = decode(bytes, name);
    if (picture.deep)
        return fromSixteenBits(picture);
    return image::toRaster({picture.width, picture.height, std::move(picture.rgba)});
}

}  // namespace vtm::compare
