/// \file
/// Origins of layers in, runs of layers that are images of each other out.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compiler/lower/lower.hpp"

namespace vtm::compiler {

/// `count` layers that stand several times in the picture, in the same order.
struct Repeat {
    struct Occurrence {
        std::uint32_t first = 0;  ///< layer
        scene::Affine fromFirst;  ///< from the first occurrence's place to this one's
    };
    std::uint32_t count = 0;
    std::vector<Occurrence> occurrences;  ///< ascending; at least two
};

/// Repeats that share no layer. Origins without a path are like no other. Outlines are the same if no point
/// differs by more than 2^-20 of `side`.
std::vector<Repeat> findRepeats(std::span<const LayerOrigin> origins, double side);

}  // namespace vtm::compiler
