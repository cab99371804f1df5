#include <vtm/image/encode.hpp>

#include <stdexcept>
#include <string>

#include "image/src/formats.hpp"

namespace vtm::image {
namespace {

/// Netpbm's P6: a header and the bytes of the colours.
class PpmEncoder : public Encoder {
public:
    PpmEncoder(int width, int height, int depth) : channelBytes_(std::size_t(depth) / 8) {
        const std::string header = "P6\n" + std::to_string(width) + " " + std::to_string(height) + "\n" +
                                   std::to_string(depth == 16 ? 65535 : 255) + "\n";
        bytes_.reserve(header.size() + std::size_t(width) * std::size_t(height) * 3 * channelBytes_);
        bytes_.assign(header.begin(), header.end());
    }
    void add(std::span<const std::uint8_t> row) override {
        for (std::size_t i = 0; i < row.size(); i += 4 * channelBytes_)
            bytes_.insert(bytes_.end(), &row[i], &row[i] + 3 * channelBytes_);
    }
    std::vector<std::uint8_t> finish() override { return std::move(bytes_); }

private:
    std::size_t channelBytes_;
    std::vector<std::uint8_t> bytes_;
};

constexpr int defaultJpegQuality = 90;

/// Largest sides: libjpeg's JPEG_MAX_DIMENSION, libwebp's WEBP_MAX_DIMENSION, and what PNG's header holds.
int maxSide(FileFormat format) {
    switch (format) {
        case FileFormat::Jpeg:
            return 65500;
        case FileFormat::Webp:
            return 16383;
        default:
            return 0x7fffffff;
    }
}

void checkSize(FileFormat format, int width, int height) {
    if (width < 1 || height < 1)
        throw CodecError("the picture has no pixels");
    if (width > maxSide(format) || height > maxSide(format))
        throw CodecError("the format allows at most " + std::to_string(maxSide(format)) + " pixels per side");
}

}  // namespace

std::optional<FileFormat> formatOfSuffix(std::string_view suffix) {
    if (suffix == ".png")
        return FileFormat::Png;
    if (suffix == ".jpg" || suffix == ".jpeg")
        return FileFormat::Jpeg;
    if (suffix == ".webp")
        return FileFormat::Webp;
    if (suffix == ".ppm")
        return FileFormat::Ppm;
    return std::nullopt;
}

std::unique_ptr<Encoder> makeEncoder(FileFormat format, int width, int height, const EncodeOptions& options) {
    if (!hasDepth(format, options.depth))
        throw std::invalid_argument("the format does not support " + std::to_string(options.depth) +
                                    " bits per channel");
    if (options.quality && (*options.quality < 1 || *options.quality > 100))
        throw std::invalid_argument("quality must be in [1, 100]");
    checkSize(format, width, height);
    switch (format) {
        case FileFormat::Jpeg:
            return makeJpegEncoder(width, height, options.quality.value_or(defaultJpegQuality));
        case FileFormat::Webp:
            return makeWebpEncoder(width, height, options.quality);
        case FileFormat::Ppm:
            return std::make_unique<PpmEncoder>(width, height, options.depth);
        default:
            return makePngEncoder(width, height, options.depth);
    }
}

std::vector<std::uint8_t> encode(const Bitmap& bitmap, FileFormat format, const EncodeOptions& options) {
    if (options.depth != 8)
        throw std::invalid_argument("a bitmap has 8 bits per channel");
    const auto encoder = makeEncoder(format, bitmap.width, bitmap.height, options);
    const std::size_t rowBytes = std::size_t(bitmap.width) * 4;
    for (std::size_t y = 0; y < std::size_t(bitmap.height); ++y)
        encoder->add(std::span(bitmap.rgba).subspan(y * rowBytes, rowBytes));
    return encoder->finish();
}

}  // namespace vtm::image
