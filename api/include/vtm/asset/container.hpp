/// \file
/// The `.vtm` file, versioned and checksummed; docs/asset_format.md specifies it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <vtm/asset/asset.hpp>
#include <vtm/error.hpp>

#pragma GCC visibility push(default)

namespace vtm::asset {

/// The bytes are not a valid asset. The message names the cause and the offset, section or record.
class FormatError : public Error {
    using Error::Error;
};

/// Returns the bytes of a file. Validates the asset first and throws FormatError wherever read() would.
std::vector<std::uint8_t> write(const AssetView& asset);

/// Returns whether the bytes begin with the signature of a `.vtm` file; the rest is not checked.
bool isContainer(std::span<const std::uint8_t> bytes);

/// Reads and validates a file. Safe for untrusted bytes: returns a valid asset or throws FormatError.
Asset read(std::span<const std::uint8_t> bytes);

/// An entry of a file's section table.
struct SectionInfo {
    std::string name;
    std::uint64_t offset = 0;
    std::uint32_t recordBytes = 0;
    std::uint64_t count = 0;
    std::uint32_t checksum = 0;  ///< stored in the file
    std::uint32_t found = 0;     ///< computed from the section's bytes

    std::uint64_t bytes() const { return recordBytes * count; }
    bool intact() const { return checksum == found; }
};

/// Returns the section table, also of a file with damaged sections. Throws FormatError if the header or the
/// table is damaged.
std::vector<SectionInfo> sectionsOf(std::span<const std::uint8_t> bytes);

/// Throws FormatError unless every index, count and number is in range, so that a renderer can trust the
/// asset: tree entries (without cycles), piece ranges, paints, programs, stack depths, commands.
void validate(const AssetView& asset);

}  // namespace vtm::asset

#pragma GCC visibility pop
