#include <png.h>

#include <csetjmp>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include "conformance/compare/compare.hpp"
#include "image/codec.hpp"

namespace vtm::compare {
namespace {

struct Decoded {
    int width = 0, height = 0;
    bool deep = false;  ///< two bytes a channel, big-endian
    std::vector<std::uint8_t> rgba;
};

/// libpng's view of a picture that is being read. The error hook must not return: it jumps.
struct Reader {
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
};

/// Asks libpng to turn every colour type of up to 8 bits into RGBA.
void expandToRgba(Reader& reader) {
    png_set_expand(reader.png);
    png_set_gray_to_rgb(reader.png);
    png_set_add_alpha(reader.png, 0xff, PNG_FILLER_AFTER);
    png_set_interlace_handling(reader.png);
    png_read_update_info(reader.png, reader.info);
}

void readHeader(Reader& reader, Decoded& picture) {
    png_read_info(reader.png, reader.info);
    picture.width = int(png_get_image_width(reader.png, reader.info));
    picture.height = int(png_get_image_height(reader.png, reader.info));
    picture.deep = png_get_bit_depth(reader.png, reader.info) == 16;
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
bool read(Reader& reader, std::FILE* file, Decoded& picture) {
    if (setjmp(png_jmpbuf(reader.png)) != 0)
        return false;
    png_init_io(reader.png, file);
    readHeader(reader, picture);
    expandToRgba(reader);
    readRows(reader, picture);
    return true;
}

Decoded decode(const std::string& path) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
    if (!file)
        throw std::runtime_error(path + ": cannot be opened");
    Reader reader;
    if (!reader.info)
        throw std::runtime_error(path + ": libpng cannot start");
    Decoded picture;
    if (!read(reader, file.get(), picture))
        throw std::runtime_error(path + ": " + reader.error);
    return picture;
}

image::Raster fromPremultiplied16(const Decoded& picture) {
    image::Raster raster(picture.width, picture.height);
    for (std::size_t i = 0; i < raster.rgba.size(); ++i)
        raster.rgba[i] = float((picture.rgba[2 * i] << 8 | picture.rgba[2 * i + 1]) / 65535.0);
    return raster;
}

}  // namespace

image::Raster readPng(const std::string& path) {
    Decoded picture = decode(path);
    if (picture.deep)
        return fromPremultiplied16(picture);
    return image::toRaster({picture.width, picture.height, std::move(picture.rgba)});
}

}  // namespace vtm::compare
