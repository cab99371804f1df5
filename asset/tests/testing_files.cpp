#include "asset/testing_files.hpp"

#include <algorithm>
#include <cstring>

#include <zlib.h>

#include <vtm/asset/container.hpp>
#include "asset/testing.hpp"

namespace vtm::asset::test {

namespace {

std::uint32_t crc(const std::uint8_t* bytes, std::size_t size, uLong before = 0) {
    return std::uint32_t(crc32_z(before, bytes, size));
}

/// As much of the table as lies in the file.
std::size_t tableEnd(const Bytes& file) {
    return std::min<std::size_t>(lineOf(std::min(word(file, atSections), 64u)), file.size());
}

}  // namespace

std::uint32_t word(const Bytes& file, std::size_t offset) {
    std::uint32_t value = 0;
    std::memcpy(&value, &file[offset], sizeof value);
    return value;
}

std::uint64_t longWord(const Bytes& file, std::size_t offset) {
    std::uint64_t value = 0;
    std::memcpy(&value, &file[offset], sizeof value);
    return value;
}

void setWord(Bytes& file, std::size_t offset, std::uint32_t value) {
    std::memcpy(&file[offset], &value, sizeof value);
}

void setLongWord(Bytes& file, std::size_t offset, std::uint64_t value) {
    std::memcpy(&file[offset], &value, sizeof value);
}

void fixChecksums(Bytes& file) {
    for (std::size_t line = headerBytes; line + lineBytes <= tableEnd(file); line += lineBytes) {
        const std::uint64_t offset = longWord(file, line + atOffset), count = longWord(file, line + atCount);
        const std::uint64_t record = word(file, line + atRecordBytes);
        if (offset <= file.size() && record > 0 && count <= (file.size() - offset) / record)
            setWord(file, line + atChecksum, crc(file.data() + offset, count * record));
    }
    const std::uint32_t head = crc(file.data(), headerBytes - 4);
    setWord(file, headerBytes - 4, crc(file.data() + headerBytes, tableEnd(file) - headerBytes, head));
}

Bytes withSection(const Bytes& file, std::uint32_t kind, std::uint32_t recordBytes, std::uint64_t count) {
    const auto padded = [](std::size_t size) { return (size + 63) / 64 * 64; };
    const std::uint32_t sections = word(file, atSections);
    const std::size_t before = padded(lineOf(sections)), shift = padded(lineOf(sections + 1)) - before;
    Bytes more(file.begin(), file.begin() + std::ptrdiff_t(lineOf(sections)));
    more.resize(before + shift);
    more.insert(more.end(), file.begin() + std::ptrdiff_t(before), file.end());
    const std::size_t line = lineOf(sections);
    for (std::uint32_t i = 0; i < sections; ++i)
        setLongWord(more, lineOf(i) + atOffset, longWord(more, lineOf(i) + atOffset) + shift);
    setWord(more, line + atKind, kind);
    setWord(more, line + atRecordBytes, recordBytes);
    setLongWord(more, line + atOffset, more.size());
    setLongWord(more, line + atCount, count);
    more.resize(padded(more.size() + recordBytes * count));
    setWord(more, atSections, sections + 1);
    setLongWord(more, atFileBytes, more.size());
    fixChecksums(more);
    return more;
}

std::string refusal(const Bytes& file) {
    try {
        read(file);
    } catch (const FormatError& error) {
        return error.what();
    }
    return {};
}

Asset everySection() {
    Asset asset = everyPaint();
    asset.images.push_back({32, 32, Bytes(32 * 32 * 4, 77)});
    asset.fallbackLeaves = 3;
    asset.filterPixels = 512;
    asset.prefilter.size = {4, 3};
    for (std::uint8_t i = 0; i < 4 * 3 + 2 * 1 + 1; ++i)
        asset.prefilter.texels.push_back({i, 20, 30, std::uint8_t(200 + i)});
    return asset;
}

}  // namespace vtm::asset::test
