/// \file
/// Writing picture files row by row: a large picture need not be held a second time as pixels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <vtm/image/bitmap.hpp>
#include <vtm/image/codec.hpp>

#pragma GCC visibility push(default)

namespace vtm::image {

enum class FileFormat { Png, Jpeg, Webp, Ppm };

/// By a file's suffix, in lower case, with its dot: .png, .jpg, .jpeg, .webp, .ppm.
std::optional<FileFormat> formatOfSuffix(std::string_view suffix);

/// JPEG and PPM have none: they take the colours as they are.
inline bool hasAlpha(FileFormat format) { return format == FileFormat::Png || format == FileFormat::Webp; }
/// Bits a channel: PNG and PPM have 8 and 16, the others 8.
inline bool hasDepth(FileFormat format, int depth) {
    return depth == 8 || (depth == 16 && (format == FileFormat::Png || format == FileFormat::Ppm));
}

struct EncodeOptions {
    int depth = 8;  ///< bits a channel
    /// 1 to 100, of JPEG and WebP. Without it JPEG has 90, and WebP keeps every pixel.
    std::optional<int> quality = {};
};

/// Takes the rows of a picture from the top, each once, then gives the file.
class Encoder {
public:
    virtual ~Encoder() = default;
    /// Straight (not premultiplied) sRGB with alpha: width * 4 bytes, or at 16 bits width * 8, the higher
    /// byte first.
    virtual void add(std::span<const std::uint8_t> row) = 0;
    /// After all rows. May throw CodecError.
    virtual std::vector<std::uint8_t> finish() = 0;
};

/// Throws CodecError for a size that the format cannot hold, std::invalid_argument for a depth that it does
/// not have and a quality outside 1 to 100.
std::unique_ptr<Encoder> makeEncoder(FileFormat format, int width, int height,
                                     const EncodeOptions& options = {});

/// The same of a picture that is there.
std::vector<std::uint8_t> encode(const Bitmap& bitmap, FileFormat format, const EncodeOptions& options = {});

}  // namespace vtm::image

#pragma GCC visibility pop
