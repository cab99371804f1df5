/// \file
/// Pictures inside a container: a table and the bytes behind it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <vtm/asset/asset.hpp>

namespace vtm::asset {

enum class ImageCoding : std::uint32_t { Raw, Zlib };

/// A line of the table. `offset` counts from the start of the pictures' bytes.
struct ImageRecord {
    std::uint32_t width = 0, height = 0;
    ImageCoding coding = ImageCoding::Raw;
    std::uint32_t unused = 0;
    std::uint64_t offset = 0, bytes = 0;
};
static_assert(sizeof(ImageRecord) == 32);

struct CodedImages {
    std::vector<ImageRecord> table;
    std::vector<std::uint8_t> bytes;
};

/// Compresses each picture for which that saves bytes.
CodedImages encodeImages(std::span<const image::Bitmap> images);

/// Throws FormatError.
std::vector<image::Bitmap> decodeImages(std::span<const ImageRecord> table,
                                        std::span<const std::uint8_t> bytes);

}  // namespace vtm::asset
