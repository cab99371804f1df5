/// \file
/// Materials inside a container: a table and the names and texts behind it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <vtm/asset/asset.hpp>

namespace vtm::asset {

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
