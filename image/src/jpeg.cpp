#include <cstddef>
#include <cstdio>
#include <cstdlib>

#include <jpeglib.h>

#include <vtm/image/codec.hpp>
#include <vtm/limits/limits.hpp>
#include "image/src/formats.hpp"

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

/// libjpeg's encoder; its errors become exceptions, which Debian's build unwinds through.
class JpegEncoder : public Encoder {
public:
    JpegEncoder(int width, int height, int quality) {
        info_.err = jpeg_std_error(&errors_);
        errors_.error_exit = throwError;
        jpeg_create_compress(&info_);
        jpeg_mem_dest(&info_, &bytes_, &size_);
        info_.image_width = JDIMENSION(width);
        info_.image_height = JDIMENSION(height);
        info_.input_components = 4;
        info_.in_color_space = JCS_EXT_RGBX;
        jpeg_set_defaults(&info_);
        jpeg_set_quality(&info_, quality, TRUE);
        info_.optimize_coding = TRUE;
        // Colours at full resolution: the edges of vector pictures are sharp in colour, too.
        info_.comp_info[0].h_samp_factor = info_.comp_info[0].v_samp_factor = 1;
        jpeg_start_compress(&info_, TRUE);
    }
    JpegEncoder(const JpegEncoder&) = delete;
    JpegEncoder& operator=(const JpegEncoder&) = delete;
    ~JpegEncoder() override {
        jpeg_destroy_compress(&info_);
        std::free(bytes_);  // NOLINT: libjpeg allocated it
    }

    void add(std::span<const std::uint8_t> row) override {
        limits::check();
        JSAMPROW line = const_cast<JSAMPROW>(row.data());  // libjpeg reads it only
        jpeg_write_scanlines(&info_, &line, 1);
    }
    std::vector<std::uint8_t> finish() override {
        jpeg_finish_compress(&info_);
        return {bytes_, bytes_ + size_};
    }

private:
    jpeg_error_mgr errors_{};
    jpeg_compress_struct info_{};
    unsigned char* bytes_ = nullptr;
    unsigned long size_ = 0;
};

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

std::unique_ptr<Encoder> makeJpegEncoder(int width, int height, int quality) {
    return std::make_unique<JpegEncoder>(width, height, quality);
}

}  // namespace vtm::image
