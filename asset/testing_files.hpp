/// \file
/// Damaged `.vtm` files for tests: where things stand in a file, and how to change them with the checksums
/// put right again, so that what lies behind the checksums is tested too.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <vtm/asset/asset.hpp>

namespace vtm::asset::test {

using Bytes = std::vector<std::uint8_t>;

inline constexpr std::size_t headerBytes = 32, lineBytes = 32;
/// Offsets in the header, and in a line of the table.
inline constexpr std::size_t atVersion = 8, atEndian = 12, atFileBytes = 16, atSections = 24;
inline constexpr std::size_t atKind = 0, atRecordBytes = 4, atOffset = 8, atCount = 16, atChecksum = 24,
                             atUnused = 28;
constexpr std::size_t lineOf(std::size_t section) { return headerBytes + section * lineBytes; }

std::uint32_t word(const Bytes& file, std::size_t offset);
std::uint64_t longWord(const Bytes& file, std::size_t offset);
void setWord(Bytes& file, std::size_t offset, std::uint32_t value);
void setLongWord(Bytes& file, std::size_t offset, std::uint64_t value);

/// Makes every checksum right whose section lies within the file.
void fixChecksums(Bytes& file);

/// The file with one section more, of zeros, behind the others.
Bytes withSection(const Bytes& file, std::uint32_t kind, std::uint32_t recordBytes, std::uint64_t count);

/// What asset::read says about a file; empty if it accepts it.
std::string refusal(const Bytes& file);

/// Every section has records; pictures raw and compressed, a prefilter of 4 × 3 texels.
Asset everySection();

}  // namespace vtm::asset::test
