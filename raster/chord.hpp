/// \file
/// What the scanner sums up: straight parts of boundaries under a view.
#pragma once

#include <cstdint>

#include <glm/vec2.hpp>

namespace vtm::asset {

/// Rows that are summed at a time: their changes stay in the cache.
inline constexpr int bandRows = 16;

/// A straight part of a boundary, in pixels. Left and right are the paints on its sides: of a chord that goes
/// down the rows, those of lower and of higher columns.
struct Chord {
    glm::vec2 a, b;
    std::uint32_t left, right;
};

}  // namespace vtm::asset
