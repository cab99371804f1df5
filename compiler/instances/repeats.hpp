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

/// Repeats that share no layer, each as long as saves most by the weights of its layers. Those that are left
/// out are like no other. No point of an outline, and none of a run, is farther than `slack`, in user units,
/// from where it would be as an image of the first.
std::vector<Repeat> findRepeats(std::span<const LayerOrigin> origins, const std::vector<bool>& isLeftOut,
                                std::span<const double> weights, double slack);

/// What a layer or a placement shows, wherever it stands.
struct Shape {
    std::uint64_t key = 0;  ///< the same for all that are alike; 0: like no other
    scene::Affine frame{};  ///< from its own space to the picture
    double size = 1;        ///< of it in its own space
    double weight = 1;      ///< what is saved where a run's map shows it
};

/// Repeats of two shapes or more that share none, each as long as saves most records, if one record places a
/// whole run. No point of a shape is farther than `slack` from where the run's map would have it.
std::vector<Repeat> findRuns(std::vector<Shape> shapes, double slack);

}  // namespace vtm::compiler
