/// \file
/// What the tests of output.hpp share: colours, their tolerances, and pictures to draw.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "asset/testing.hpp"
#include "backend_gl/tests/gl_fixture.hpp"
#include "raster/testing_views.hpp"

namespace vtm::gl {

using asset::Asset;
using asset::View;
using namespace asset::test;
using Color = std::array<double, 4>;

inline constexpr double byteStep = 1.0 / 255;
/// Of a stored byte against the number that was stored, with a hundredth of a step for the driver's
/// arithmetic.
inline constexpr double halfByte = 0.51 * byteStep;
/// Of single precision and pow() on the way.
inline constexpr double conversion = 1e-5;

inline double decoded(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }
inline double encoded(double v) { return v <= 0.0031308 ? v * 12.92 : 1.055 * std::pow(v, 1 / 2.4) - 0.055; }

inline Color straight(const Color& c) {
    Color result = c;
    for (std::size_t i = 0; i < 3; ++i)
        result[i] = c[3] > 0 ? std::min(c[i] / c[3], 1.0) : 0;
    return result;
}
inline Color toLinear(const Color& c) {
    Color result = straight(c);
    for (std::size_t i = 0; i < 3; ++i)
        result[i] = decoded(result[i]) * c[3];
    return result;
}
inline Color identity(const Color& c) { return c; }

inline Color pixelOf(const image::Raster& raster, int x, int y) {
    const float* p = raster.pixel(x, y);
    return {p[0], p[1], p[2], p[3]};
}

inline image::Raster rasterOf(const UserFramebuffer& target) {
    image::Raster raster(target.width, target.height);
    std::ranges::transform(target.bytes(), raster.rgba.begin(),
                           [](std::uint8_t b) { return float(b) / 255.0f; });
    return raster;
}

inline constexpr int side = 48;
inline View turned() { return turnedView(side, side, {32, 32}, 0.7, 0.4); }

inline std::vector<Asset> assets() { return {disc(), everyPaint(), layers()}; }

/// The largest difference of the target's pixels to made(colour of render()).
inline double worst(const image::Raster& drawn, const image::Raster& picture,
                    const std::function<Color(const Color&)>& made) {
    double maximum = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const Color expected = made(pixelOf(picture, x, y)), got = pixelOf(drawn, x, y);
            for (std::size_t c = 0; c < 4; ++c)
                maximum = std::max(maximum, std::abs(got[c] - expected[c]));
        }
    return maximum;
}

}  // namespace vtm::gl
