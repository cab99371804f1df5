/// \file
/// The `.vtm` file: docs/asset_format.md, versioned and checksummed.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "asset/asset.hpp"

namespace vtm::asset {

/// Says what is wrong with the bytes and at which offset.
class FormatError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

std::vector<std::uint8_t> write(const Asset& asset);

/// Reads and validates hostile bytes: whatever they are, a valid asset or a FormatError.
Asset read(std::span<const std::uint8_t> bytes);

/// Throws FormatError unless every index, count and number is in range, so that no renderer can be
/// led astray: tree entries without cycles, piece ranges, paints, programs, stack depths, commands.
void validate(const Asset& asset);

}  // namespace vtm::asset
