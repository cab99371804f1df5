/// \file
/// Pictures of any size that are hard on planarising: what they are made of meets far more often than it
/// grows.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace vtm::bench {

struct TrapFamily {
    const char* name;
    const char* text;                    ///< what there are n of
    std::string (*make)(std::size_t n);  ///< an SVG file of 500 × 500 units, the same on every machine
};
std::span<const TrapFamily> trapFamilies();

}  // namespace vtm::bench
