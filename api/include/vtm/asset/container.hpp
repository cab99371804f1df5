/// \file
/// The `.vtm` file: docs/asset_format.md, versioned and checksummed.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <vtm/asset/asset.hpp>
#include <vtm/error.hpp>

#pragma GCC visibility push(default)

namespace vtm::asset {

/// Says what is wrong with the bytes and where: an offset, a section, a record.
class FormatError : public Error {
    using Error::Error;
};

/// Throws FormatError where read() would refuse the file: write() validates first, by the same rules.
std::vector<std::uint8_t> write(const AssetView& asset);

/// Whether they begin as a `.vtm` file does, whole or not.
bool isContainer(std::span<const std::uint8_t> bytes);

/// Reads and validates hostile bytes: whatever they are, a valid asset or a FormatError.
Asset read(std::span<const std::uint8_t> bytes);

/// A line of a file's section table.
struct SectionInfo {
    std::string name;
    std::uint64_t offset = 0;
    std::uint32_t recordBytes = 0;
    std::uint64_t count = 0;
    std::uint32_t checksum = 0;  ///< as stored
    std::uint32_t found = 0;     ///< of the section's bytes

    std::uint64_t bytes() const { return recordBytes * count; }
    bool intact() const { return checksum == found; }
};

/// Also for a file whose sections are damaged; throws FormatError where its header or table is.
std::vector<SectionInfo> sectionsOf(std::span<const std::uint8_t> bytes);

/// Throws FormatError unless every index, count and number is in range, so that no renderer can be
/// led astray: tree entries without cycles, piece ranges, paints, programs, stack depths, commands.
void validate(const AssetView& asset);

}  // namespace vtm::asset

#pragma GCC visibility pop
