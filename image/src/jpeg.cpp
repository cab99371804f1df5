#include <cstddef>
#include <cstdio>

#include <jpeglib.h>

#include <vtm/image/codec.hpp>
#include <vtm/limits/limits.hpp>
#include "image/src/decoders.hpp"

namespace vtm::image {
namespace {

[[noreturn]] void throwError(j_common_ptr info) {
    char message[JMSG_LENGTH_MAX];
    info->err->format_message(info, message);
    throw CodecError(std::string("JPEG: ") + message);
}

void ignoreMessage(j_common_ptr, int) {}

/// libjpeg's decoder; its errors become exceptions, which Debian's build unwinds through.
struct Decoder {
    jpeg_error_mgr errors{};
    jpeg_decompress_struct info{};

    explicit Decoder(Bytes bytes) {
        info.err = jpeg_std_error(&errors);
        errors.error_exit = throwError;
        errors.emit_message = ignoreMessage;
        jpeg_create_decompress(&info);
        jpeg_mem_src(&info, bytes.data(), bytes.size());
    }
    Decoder(const Decoder&) = delete;
    Decoder& operator=(const Decoder&) = delete;
    ~Decoder() { jpeg_destroy_decompress(&info); }
};

bool isCmyk(const jpeg_decompress_struct& info) {
    return info.jpeg_color_space == JCS_CMYK || info.jpeg_color_space == JCS_YCCK;
}

/// Adobe's files, the only CMYK ones met in practice, hold inverted inks: light = ink * black.
void cmykToRgba(std::uint8_t* row, int width) {
    for (int x = 0; x < width; ++x, row += 4) {
        for (int c = 0; c < 3; ++c)
            row[c] = static_cast<std::uint8_t>(row[c] * row[3] / 255);
        row[3] = 255;
    }
}

}  // namespace

bool isJpeg(Bytes bytes) {
    return bytes.size() >= 3 && bytes[0] == 0xff && bytes[1] == 0xd8 && bytes[2] == 0xff;
}

Bitmap decodeJpeg(Bytes bytes) {
    Decoder decoder(bytes);
    jpeg_read_header(&decoder.info, TRUE);
    Bitmap bitmap = makeBitmap(decoder.info.image_width, decoder.info.image_height);
    const bool cmyk = isCmyk(decoder.info);
    decoder.info.out_color_space = cmyk ? JCS_CMYK : JCS_EXT_RGBA;
    jpeg_start_decompress(&decoder.info);
    while (decoder.info.output_scanline < decoder.info.output_height) {
        limits::check();
        JSAMPROW row =
            &bitmap.rgba[std::size_t(decoder.info.output_scanline) * std::size_t(bitmap.width) * 4];
        jpeg_read_scanlines(&decoder.info, &row, 1);
        if (cmyk)
            cmykToRgba(row, bitmap.width);
    }
    return bitmap;
}

}  // namespace vtm::image
