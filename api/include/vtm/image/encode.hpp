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

/// Returns the format for a lower-case suffix with its dot: .png, .jpg, .jpeg, .webp or .ppm; empty for
/// others.
std::optional<FileFormat> formatOfSuffix(std::string_view suffix);

/// Returns whether the format stores alpha. JPEG and PPM drop it and keep the straight colours.
inline bool hasAlpha(FileFormat format) { return format == FileFormat::Png || format == FileFormat::Webp; }
/// Bits a channel: PNG and PPM have 8 and 16, the others 8.
inline bool hasDepth(FileFormat format, int depth) {
    return depth == 8 || (depth == 16 && (format == FileFormat::Png || format == FileFormat::Ppm));
}

struct EncodeOptions {
    int depth = 8;  ///< bits a channel
    /// Quality of JPEG and WebP, 1 to 100. Empty: 90 for JPEG, lossless for WebP.
    std::optional<int> quality = {};
};

/// Takes each row of a picture once, from the top, and then returns the bytes of the file.
class Encoder {
public:
    virtual ~Encoder() = default;
    /// Straight (not premultiplied) sRGB with alpha: width * 4 bytes, or at 16 bits width * 8, the higher
    /// byte first.
    virtual void add(std::span<const std::uint8_t> row) = 0;
    /// Call after all rows. Returns the file's bytes. May throw CodecError.
    virtual std::vector<std::uint8_t> finish() = 0;
};

/// Throws CodecError if the format cannot hold the size, and std::invalid_argument for an unsupported depth
/// or a quality outside 1 to 100.
std::unique_ptr<Encoder> makeEncoder(FileFormat format, int width, int height,
                                     const EncodeOptions& options = {});

/// Encodes a bitmap that is already in memory.
std::vector<std::uint8_t> encode(const Bitmap& bitmap, FileFormat format, const EncodeOptions& options = {});

}  // namespace vtm::image

#pragma GCC visibility pop
