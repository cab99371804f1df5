/// \file
/// The sections of a container that are not plain records: pictures and materials, each a table and the bytes
/// behind it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <vtm/asset/asset.hpp>

namespace vtm::asset {

// ---- Pictures -------------------------------------------------------------------------------------

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

// ---- Materials ------------------------------------------------------------------------------------

/// A line of the table. The name and then the text follow those of the line before.
struct MaterialRecord {
    std::uint32_t nameBytes = 0, textBytes = 0;
    std::uint64_t unused = 0;
};
static_assert(sizeof(MaterialRecord) == 16);

struct CodedMaterials {
    std::vector<MaterialRecord> table;
    std::vector<std::uint8_t> bytes;
};

CodedMaterials encodeMaterials(std::span<const Material> materials);

/// Throws FormatError.
std::vector<Material> decodeMaterials(std::span<const MaterialRecord> table,
                                      std::span<const std::uint8_t> bytes);

}  // namespace vtm::asset
