#include "asset/src/container_layout.hpp"

#include <fmt/format.h>
#include <zlib.h>

namespace vtm::asset {

namespace {

constexpr std::array<const char*, 13> names{
    "picture", "maps",   "commands",    "nodes",     "leaves",    "pieces",        "paints",
    "data",    "images", "image bytes", "prefilter", "materials", "material bytes"};

}  // namespace

std::string nameOf(SectionKind kind) {
    if (kind == SectionKind::Accuracy)
        return "accuracy";
    const auto index = std::size_t(kind);
    return index < names.size() ? names[index] : fmt::format("{:#x}", index);
}

std::uint32_t checksumOf(std::span<const std::uint8_t> bytes) {
    return std::uint32_t(crc32_z(crc32_z(0, nullptr, 0), bytes.data(), bytes.size()));
}

std::uint32_t headerChecksum(std::span<const std::uint8_t> file, std::size_t end) {
    const uLong head = crc32_z(crc32_z(0, nullptr, 0), file.data(), offsetof(FileHeader, checksum));
    return std::uint32_t(crc32_z(head, file.data() + sizeof(FileHeader), end - sizeof(FileHeader)));
}

}  // namespace vtm::asset
