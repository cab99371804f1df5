/// \file
/// How far drawn boundaries lie from true outlines, and true ones from drawn ones.
#pragma once

#include <cstdint>

#include "asset/asset.hpp"
#include "scene/scene.hpp"

namespace vtm::cases {

/// The largest that were found, in tolerances.
struct Distances {
    double fromDrawn = 0, fromTrue = 0;  ///< infinite if beyond two
    int drawn = 0, truths = 0;           ///< points measured
};

/// Looks at up to `points` points of each: of the drawn ones those where two colours meet, of the true ones
/// those where an outline shows and no other does near by (threads thinner than the tolerance may vanish).
/// `tolerance` in picture units.
Distances measure(const scene::Scene& scene, const asset::Asset& asset, double tolerance, std::uint64_t seed,
                  int points);

}  // namespace vtm::cases
