/// \file
/// Font files taken apart and put together.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace vtm::text {

using Bytes = std::vector<std::uint8_t>;

inline Bytes bytesOf(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

inline std::uint32_t numberAt(const Bytes& bytes, std::size_t at, int size) {
    std::uint32_t value = 0;
    for (int i = 0; i < size; ++i)
        value = value << 8 | bytes.at(at + std::size_t(i));
    return value;
}

inline void append(Bytes& bytes, std::uint32_t value, int size) {
    for (int i = size - 1; i >= 0; --i)
        bytes.push_back(std::uint8_t(value >> (8 * i)));
}

struct Table {
    std::uint32_t tag, checksum;
    Bytes bytes;
};

inline std::vector<Table> tablesOf(const Bytes& sfnt) {
    std::vector<Table> tables;
    for (std::size_t i = 0; i < numberAt(sfnt, 4, 2); ++i) {
        const std::size_t entry = 12 + 16 * i;
        const auto begin = sfnt.begin() + numberAt(sfnt, entry + 8, 4);
        tables.push_back({numberAt(sfnt, entry, 4), numberAt(sfnt, entry + 4, 4),
                          Bytes(begin, begin + numberAt(sfnt, entry + 12, 4))});
    }
    return tables;
}

inline Bytes sfntOf(std::vector<Table> tables, std::uint32_t flavor = 0x00010000) {
    std::sort(tables.begin(), tables.end(), [](const Table& a, const Table& b) { return a.tag < b.tag; });
    Bytes sfnt;
    append(sfnt, flavor, 4);
    append(sfnt, std::uint32_t(tables.size()), 2);
    append(sfnt, 0, 2);
    append(sfnt, 0, 4);
    std::size_t offset = 12 + 16 * tables.size();
    for (const Table& table : tables) {
        append(sfnt, table.tag, 4);
        append(sfnt, table.checksum, 4);
        append(sfnt, std::uint32_t(offset), 4);
        append(sfnt, std::uint32_t(table.bytes.size()), 4);
        offset += (table.bytes.size() + 3) / 4 * 4;
    }
    for (const Table& table : tables) {
        sfnt.insert(sfnt.end(), table.bytes.begin(), table.bytes.end());
        sfnt.resize((sfnt.size() + 3) / 4 * 4);
    }
    return sfnt;
}

}  // namespace vtm::text
