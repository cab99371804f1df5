/// \file
/// How far drawn boundaries lie from true outlines, and true ones from drawn ones.
#pragma once

#include <cstdint>
#include <vector>

#include <vtm/asset/asset.hpp>
#include <vtm/scene/scene.hpp>

namespace vtm::cases {

/// The largest that were found, in tolerances.
struct Distances {
    double fromDrawn = 0, fromTrue = 0;  ///< infinite if beyond two
    int drawn = 0, truths = 0;           ///< points measured
};

/// Of up to `points` points of drawn boundaries those where two colours meet and that no true outline is
/// nearer to than `tolerance`, picture units.
struct FarPoints {
    std::vector<scene::Point> at;
    int looked = 0;
};
FarPoints farPoints(const scene::Scene& scene, const asset::Asset& asset, double tolerance,
                    std::uint64_t seed, int points);

/// Looks at up to `drawn` drawn points, of which those count where two colours meet, and at up to `truths`
/// true ones, those where an outline shows and no other does near by (threads thinner than the tolerance may
/// vanish): these take far longer. `tolerance` in picture units.
Distances measure(const scene::Scene& scene, const asset::Asset& asset, double tolerance, std::uint64_t seed,
                  int drawn, int truths);

}  // namespace vtm::cases
