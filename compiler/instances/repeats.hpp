/// \file
/// Layers or placements in, runs of them that are images of each other out.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compiler/lower/lower.hpp"

namespace vtm::compiler {

/// `count` shapes that stand several times in the picture, in the same order.
struct Repeat {
    struct Occurrence {
        std::uint32_t first = 0;  ///< shape
        scene::Affine fromFirst;  ///< from the first occurrence's place to this one's
    };
    std::uint32_t count = 0;
    std::vector<Occurrence> occurrences;  ///< ascending; at least two
};

/// Repeats that share no layer, each as long as saves most layers. Origins without a path are like no other.
/// Outlines are the same if no point differs by more than 2^-20 of `side`.
std::vector<Repeat> findRepeats(std::span<const LayerOrigin> origins, double side);

/// What a layer or a placement shows, wherever it stands.
struct Shape {
    std::uint64_t key = 0;  ///< the same for all that are alike; 0: like no other
    scene::Affine frame{};  ///< from its own space to the picture
    double size = 1;        ///< of it in its own space
};

/// Repeats of two shapes or more that share none, each as long as saves most records, if one record places a
/// whole run. No point of a shape is farther than `slack` from where the run's map would have it.
std::vector<Repeat> findRuns(std::vector<Shape> shapes, double slack);

}  // namespace vtm::compiler
