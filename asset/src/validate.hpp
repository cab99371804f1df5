/// \file
/// The parts of asset::validate.
#pragma once

#include <cmath>
#include <string>

#include <fmt/format.h>

#include <vtm/asset/container.hpp>

namespace vtm::asset {

/// Names the record at fault: require(ok, "leaves", 3, "piece range is out of bounds").
inline void require(bool holds, const char* section, std::size_t index, const char* what) {
    if (!holds)
        throw FormatError(fmt::format("{}[{}]: {}", section, index, what));
}

inline bool isShare(float value) { return value >= 0 && value <= 1; }

void validatePaints(const AssetView& asset);
void validateFilters(const AssetView& asset);

}  // namespace vtm::asset
