/// \file
/// Boundaries as the engines draw them, and their distances from the true outlines.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include <vtm/asset/asset.hpp>
#include <vtm/scene/scene.hpp>
#include "asset/instances.hpp"

namespace vtm::cases {

class DrawnBoundary {
public:
    /// Of maps of colours, whose pieces part different ones; the asset is closed.
    explicit DrawnBoundary(const asset::Asset& asset);

    /// From a point to the nearest boundary, up to `maximum`, beyond which it is infinite. Never too small.
    double distance(glm::dvec2 from, double maximum) const;
    /// Points anywhere on the pieces.
    std::vector<glm::dvec2> somePoints(std::uint64_t seed, int count) const;
    /// Where pieces end on the borders of their leaves.
    const std::vector<glm::dvec2>& crossings() const { return crossings_; }

private:
    /// a + s ab + t(s) across, t(s) = slopeA s (1 - s)² - slopeB s² (1 - s). Picture units. In a map that is
    /// not placed in another one, `across` is perp(ab).
    struct Curve {
        glm::dvec2 a, ab, across;
        double slopeA, slopeB;
        glm::dvec2 at(double s) const;
        glm::dvec2 derivative(double s) const;
        double distance(glm::dvec2 from) const;
    };
    void add(const asset::Asset& asset, const asset::PlacedMap& placed);

    std::vector<Curve> curves_;
    std::vector<glm::dvec2> crossings_;
};

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
