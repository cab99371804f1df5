#include "asset/src/container_layout.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <vtm/image/codec.hpp>
#include "asset/src/validate.hpp"

namespace vtm::asset {

namespace {

constexpr std::array<const char*, 20> names{"picture",
                                            "maps",
                                            "commands",
                                            "nodes",
                                            "leaves",
                                            "pieces",
                                            "paints",
                                            "data",
                                            "images",
                                            "image bytes",
                                            "prefilter",
                                            "materials",
                                            "material bytes",
                                            "instance trees",
                                            "instances",
                                            "symbols",
                                            "palettes",
                                            "filters",
                                            "filter primitives",
                                            "filter words"};

}  // namespace

std::string nameOf(SectionKind kind) {
    constexpr std::array<const char*, 5> ignorable{"accuracy", "font", "glyphs", "glyph parts",
                                                   "drawn filters"};
    const auto index = std::size_t(kind);
    if (index >= ignorableBit && index - ignorableBit < ignorable.size())
        return ignorable[index - ignorableBit];
    return index < names.size() ? names[index] : fmt::format("{:#x}", index);
}

std::uint32_t checksumOf(std::span<const std::uint8_t> bytes) {
    return std::uint32_t(crc32_z(crc32_z(0, nullptr, 0), bytes.data(), bytes.size()));
}

std::uint32_t headerChecksum(std::span<const std::uint8_t> file, std::size_t end) {
    const uLong head = crc32_z(crc32_z(0, nullptr, 0), file.data(), offsetof(FileHeader, checksum));
    return std::uint32_t(crc32_z(head, file.data() + sizeof(FileHeader), end - sizeof(FileHeader)));
}

// ---- Pictures -------------------------------------------------------------------------------------

namespace {

std::vector<std::uint8_t> deflated(const std::vector<std::uint8_t>& raw) {
    uLongf length = compressBound(uLong(raw.size()));
    std::vector<std::uint8_t> bytes(length);
    if (compress2(bytes.data(), &length, raw.data(), uLong(raw.size()), Z_BEST_COMPRESSION) != Z_OK)
        return raw;
    bytes.resize(length);
    return bytes;
}

/// Never writes beyond the size that the table's width and height ask for.
std::vector<std::uint8_t> inflated(std::span<const std::uint8_t> bytes, std::size_t size, std::size_t index) {
    std::vector<std::uint8_t> raw(size);
    uLongf length = uLongf(size);
    uLong consumed = uLong(bytes.size());
    const int result = uncompress2(raw.data(), &length, bytes.data(), &consumed);
    require(result == Z_OK && length == size && consumed == bytes.size(), "images", index,
            "zlib stream is damaged");
    return raw;
}

image::Bitmap decodeImage(const ImageRecord& record, std::span<const std::uint8_t> bytes, std::size_t index) {
    constexpr auto maximum = std::uint64_t(image::maxDecodedPixels);
    require(record.unused == 0, "images", index, "unused word is not zero");
    require(record.width > 0 && record.height > 0 && record.width <= maximum &&
                record.height <= maximum / record.width,
            "images", index, "size is out of range");
    const std::size_t size = std::size_t(record.width) * record.height * 4;
    image::Bitmap bitmap{int(record.width), int(record.height), {}};
    if (record.coding == ImageCoding::Zlib) {
        bitmap.rgba = inflated(bytes, size, index);
        return bitmap;
    }
    require(record.coding == ImageCoding::Raw, "images", index, "coding is unknown");
    require(bytes.size() == size, "images", index, "bytes do not match the size");
    bitmap.rgba.assign(bytes.begin(), bytes.end());
    return bitmap;
}

}  // namespace

CodedImages encodeImages(std::span<const image::Bitmap> images) {
    CodedImages coded;
    for (const image::Bitmap& bitmap : images) {
        const std::vector<std::uint8_t> small = deflated(bitmap.rgba);
        const bool saves = small.size() < bitmap.rgba.size();
        const std::vector<std::uint8_t>& bytes = saves ? small : bitmap.rgba;
        coded.table.push_back({std::uint32_t(bitmap.width), std::uint32_t(bitmap.height),
                               saves ? ImageCoding::Zlib : ImageCoding::Raw, 0, coded.bytes.size(),
                               bytes.size()});
        coded.bytes.insert(coded.bytes.end(), bytes.begin(), bytes.end());
    }
    return coded;
}

std::vector<image::Bitmap> decodeImages(std::span<const ImageRecord> table,
                                        std::span<const std::uint8_t> bytes) {
    std::vector<image::Bitmap> images;
    std::uint64_t next = 0, pixels = 0;
    for (std::size_t i = 0; i < table.size(); ++i) {
        const ImageRecord& record = table[i];
        require(record.offset == next && record.bytes <= bytes.size() - next, "images", i,
                "bytes do not follow those of the picture before");
        pixels += std::uint64_t(record.width) * record.height;
        require(pixels <= std::uint64_t(image::maxDecodedPixels), "images", i,
                "pictures have too many pixels");
        images.push_back(decodeImage(record, bytes.subspan(next, record.bytes), i));
        next += record.bytes;
    }
    require(next == bytes.size(), "images", table.size(), "there are unused bytes");
    return images;
}

// ---- Materials ------------------------------------------------------------------------------------

CodedMaterials encodeMaterials(std::span<const Material> materials) {
    CodedMaterials coded;
    for (const Material& m : materials) {
        coded.table.push_back({std::uint32_t(m.name.size()), std::uint32_t(m.glsl.size()), 0});
        coded.bytes.insert(coded.bytes.end(), m.name.begin(), m.name.end());
        coded.bytes.insert(coded.bytes.end(), m.glsl.begin(), m.glsl.end());
    }
    return coded;
}

std::vector<Material> decodeMaterials(std::span<const MaterialRecord> table,
                                      std::span<const std::uint8_t> bytes) {
    std::vector<Material> materials;
    std::size_t next = 0;
    const auto take = [&](std::size_t count) {
        require(count <= bytes.size() - next, "materials", materials.size(), "text ends early");
        const auto text = bytes.subspan(next, count);
        next += count;
        return std::string(text.begin(), text.end());
    };
    for (const MaterialRecord& record : table) {
        require(record.unused == 0, "materials", materials.size(), "unused word is not zero");
        Material material;
        material.name = take(record.nameBytes);
        material.glsl = take(record.textBytes);
        materials.push_back(std::move(material));
    }
    require(next == bytes.size(), "materials", table.size(), "there are unused bytes");
    return materials;
}

}  // namespace vtm::asset
