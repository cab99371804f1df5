/// \file
/// Comparing what two assets draw.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include <vtm/asset/asset.hpp>
#include <vtm/raster/evaluate.hpp>
#include <vtm/scene/path.hpp>

namespace vtm::compiler::test {

/// Pixels a side of the pictures that are compared.
inline constexpr int pixels = 80;
/// Colours are the same within this; single precision leaves less.
inline constexpr float colourStep = 1e-3f;

using Colour = std::array<float, 4>;

inline double sideOf(const asset::Asset& asset) { return std::max(asset.width, asset.height); }

/// `count` by `count` pixels over the square of `side` round `centre`.
inline image::Raster draw(const asset::Asset& asset, scene::Point centre, double side, int count) {
    const double scale = count / side;
    const scene::Point origin = centre - scene::Point{side / 2, side / 2};
    return asset::evaluate(asset, {count, count, {scale, 0, 0, scale, -scale * origin.x, -scale * origin.y}});
}

inline Colour colour(const image::Raster& raster, std::size_t pixel) {
    Colour c;
    std::copy_n(raster.rgba.begin() + static_cast<std::ptrdiff_t>(4 * pixel), 4, c.begin());
    return c;
}

inline bool isSame(const Colour& a, const Colour& b) {
    return std::equal(a.begin(), a.end(), b.begin(),
                      [](float x, float y) { return std::abs(x - y) <= colourStep; });
}

/// Two assets of one scene, made with the same options.
class Comparison {
public:
    Comparison(const asset::Asset& a, const asset::Asset& b, double tolerance)
        : a_(a), b_(b), distance_(tolerance * sideOf(a)) {}

    /// Every pixel that differs is looked at in 64 points.
    void run() const {
        const double side = sideOf(a_), step = side / pixels;
        const scene::Point middle{side / 2, side / 2};
        const image::Raster p = draw(a_, middle, side, pixels), q = draw(b_, middle, side, pixels);
        constexpr int points = 8;
        for (std::size_t i = 0; i < std::size_t{pixels} * pixels; ++i) {
            if (isSame(colour(p, i), colour(q, i)))
                continue;
            for (int k = 0; k < points * points; ++k) {
                const scene::Point within{(k % points + 0.5) / points, (k / points + 0.5) / points};
                expectSame(step * (scene::Point{double(i % pixels), double(i / pixels)} + within));
            }
        }
    }

private:
    /// At a point the assets agree, unless one of its boundaries is near: each lies within the tolerance of
    /// the true one, so twice that from the other asset's.
    void expectSame(scene::Point at) const {
        constexpr double pointShare = 1.0 / 8;
        const Colour a = colour(draw(a_, at, distance_ * pointShare, 1), 0);
        const Colour b = colour(draw(b_, at, distance_ * pointShare, 1), 0);
        if (!isSame(a, b)) {
            EXPECT_TRUE(isBoundaryNear(at, b)) << "at " << at.x << ", " << at.y;
        }
    }

    bool isBoundaryNear(scene::Point at, const Colour& there) const {
        constexpr int count = 8;
        const image::Raster near = draw(b_, at, 2 * 2 * distance_, count);
        for (std::size_t i = 0; i < std::size_t{count} * count; ++i)
            if (!isSame(colour(near, i), there))
                return true;
        return false;
    }

    const asset::Asset &a_, &b_;
    const double distance_;
};

}  // namespace vtm::compiler::test
