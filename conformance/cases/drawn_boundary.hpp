/// \file
/// Where an asset draws boundaries: its pieces, and the borders of squares that differ.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include <vtm/asset/asset.hpp>

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
    /// a + s ab + t(s) perp(ab), t(s) = slopeA s (1 - s)² - slopeB s² (1 - s). Picture units.
    struct Curve {
        glm::dvec2 a, ab;
        double slopeA, slopeB;
        glm::dvec2 at(double s) const;
        glm::dvec2 derivative(double s) const;
        double distance(glm::dvec2 from) const;
    };
    std::vector<Curve> curves_;
    std::vector<glm::dvec2> crossings_;
};

}  // namespace vtm::cases
