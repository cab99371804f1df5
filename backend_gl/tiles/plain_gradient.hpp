/// \file
/// A gradient near a tile: the colours of its ramp by offset, and what the offset is at a point.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <vtm/asset/asset.hpp>
#include "asset/records.hpp"
#include "backend_gl/tiles/plain_paints.hpp"

namespace vtm::gl::plain {

/// Of a gradient, and of all periods near a tile.
inline constexpr std::uint32_t maxPlainStops = 256;
/// Offsets, on both sides of which a ramp's colour is asked for.
inline constexpr double besideStop = 1e-6;

inline double largest(const glm::dvec4& c) { return std::max({c.r, c.g, c.b, c.a}); }
inline bool isAlike(const glm::dvec4& a, const glm::dvec4& b, double most) {
    return largest(glm::abs(a - b)) <= most;
}

/// Straight colours by offset.
class Ramp {
public:
    Ramp(std::span<const asset::Texel> data, std::uint32_t texel, const asset::Gradient& gradient);

    /// Premultiplied.
    glm::dvec4 at(double u) const;
    /// Offsets in a range at which the ramp may bend or jump; nothing where they are many.
    std::optional<std::vector<double>> corners(double from, double to) const;
    bool isOpaque() const;

private:
    glm::dvec4 straight(double u) const;

    asset::Spread spread_;
    std::vector<double> offsets_;
    std::vector<glm::dvec4> colors_;
};

struct Interval {
    double from, to;

    /// Distances from 0.
    double least() const { return std::max({from, -to, 0.0}); }
    double most() const { return std::max(std::abs(from), std::abs(to)); }
};

/// t of a point in tile sides: a linear function, or |q| + e q.x of two. The offset is u = t - start.
struct Place {
    std::array<double, 3> x{}, y{};
    double e = 0, start = 0;
    bool isRadial = false;

    double at(glm::dvec2 p) const;
    /// What it is at the points of the unit square and up to `margin` away from them.
    Interval over(double margin) const;
    /// What t changes by over a tile's side, at most, and of a cone that without e.
    double slope() const { return stretch() * (1 + e); }
    double stretch() const;
    double area() const { return std::abs(x[0] * y[1] - x[1] * y[0]); }
    bool isFinite() const;
};

/// Nothing where a radial gradient's circles hardly lie within each other, or numbers are too large.
std::optional<Place> placeOf(const asset::Gradient& gradient, bool isRadial, const TileFrame& frame);

}  // namespace vtm::gl::plain
