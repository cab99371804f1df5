/// \file
/// What stands where in a `.vtm` file: docs/asset_format.md in code.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <vtm/asset/asset.hpp>
#include <vtm/asset/container.hpp>

namespace vtm::asset {

// Sections are the records themselves; a big-endian machine would have to swap every word.
static_assert(std::endian::native == std::endian::little);

/// A carriage return, a line feed and DOS's end of file: transfers as text damage it visibly.
inline constexpr std::array<std::uint8_t, 8> fileMagic{'V', 'T', 'M', 0xB6, '\r', '\n', 0x1A, '\n'};
/// What tells a `.vtm` file, even one whose line ends were changed on the way: what begins like text, and is
/// none.
inline constexpr std::size_t telltaleBytes = 4;
inline constexpr std::uint32_t fileVersion = 2;
inline constexpr std::uint32_t endianMark = 0x01020304;
/// Where sections begin: a cache line, and a multiple of every record's alignment.
inline constexpr std::size_t sectionAlignment = 64;

struct FileHeader {
    std::array<std::uint8_t, 8> magic{};
    std::uint32_t version = 0, endian = 0;
    std::uint64_t fileBytes = 0;
    std::uint32_t sections = 0;
    std::uint32_t checksum = 0;  ///< of what stands before it and of the section table
};
static_assert(sizeof(FileHeader) == 32);

/// Numbers are part of the format: they are never used again for something else.
enum class SectionKind : std::uint32_t {
    Picture,
    Maps,
    Commands,
    Nodes,
    Leaves,
    Pieces,
    Paints,
    Data,
    Images,
    ImageBytes,
    Prefilter,
    Materials,
    MaterialBytes,
    InstanceTrees,
    Instances,
    Symbols,
    Palettes,
    Filters,
    FilterPrimitives,
    FilterWords,
    Accuracy = 0x80000000u,  ///< a reader may do without it and those that follow
    Font,
    Glyphs,
    GlyphParts,
    DrawnFilters
};
/// Sections up to this one stand in every file, empty or not; those after it only where they are not
/// empty.
inline constexpr SectionKind lastRequired = SectionKind::ImageBytes;
inline constexpr SectionKind lastKnown = SectionKind::FilterWords;
/// A reader skips a section of unknown kind if this bit is set, and refuses the file if it is not.
inline constexpr std::uint32_t ignorableBit = 0x80000000u;
/// Bounds the table of a hostile file.
inline constexpr std::uint32_t maxSections = 64;

/// "pieces"; a number for kinds that are unknown.
std::string nameOf(SectionKind kind);

/// A line of the section table.
struct SectionLine {
    SectionKind kind = SectionKind::Picture;
    std::uint32_t recordBytes = 0;
    std::uint64_t offset = 0, count = 0;
    std::uint32_t checksum = 0;
    std::uint32_t unused = 0;
};
static_assert(sizeof(SectionLine) == 32);

struct PictureRecord {
    double width = 0, height = 0;
    Mode mode = Mode::Exact;
    std::uint32_t fallbackLeaves = 0;
    PyramidSize prefilter;
};
static_assert(sizeof(PictureRecord) == 32);

struct AccuracyRecord {
    double finestPixel = 0;
    std::uint64_t unused = 0;
};
static_assert(sizeof(AccuracyRecord) == 16);

/// Of filters that were drawn when the picture was compiled.
struct DrawnFiltersRecord {
    std::uint32_t pixels = 0;  ///< along the picture's longer side
    std::uint32_t unused[3] = {};
};
static_assert(sizeof(DrawnFiltersRecord) == 16);

constexpr std::uint64_t alignedOffset(std::uint64_t offset) {
    return (offset + sectionAlignment - 1) / sectionAlignment * sectionAlignment;
}

std::uint32_t checksumOf(std::span<const std::uint8_t> bytes);
/// Of a file's header and section table, which end at `end`.
std::uint32_t headerChecksum(std::span<const std::uint8_t> file, std::size_t end);

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

/// `view` points into the file's bytes and into `images` and `materials`, the only parts that are decoded.
struct Contents {
    AssetView view;
    std::vector<image::Bitmap> images;
    std::vector<Material> materials;
};

/// `bytes` must begin at a multiple of recordAlignment and outlive the contents. Throws FormatError.
Contents openContents(std::span<const std::uint8_t> bytes);
inline constexpr std::size_t recordAlignment = 16;

}  // namespace vtm::asset
