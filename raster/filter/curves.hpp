/// \file
/// The transfer function of sRGB (IEC 61966-2-1) and its inverse, from tables.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "raster/src/float4.hpp"

namespace vtm::asset {

/// A function on [0, 1], interpolated in a table over √x: there both curves bend little, so that 4096 steps
/// are within 2^-20 of them.
class Curve {
public:
    explicit Curve(double (*function)(double));
    float operator()(float x) const {
        const float at = std::sqrt(unit(x)) * float(steps);
        const auto index = std::size_t(at);
        return table_[index] + (at - float(index)) * (table_[index + 1] - table_[index]);
    }

private:
    static constexpr std::size_t steps = 4096;
    std::array<float, steps + 2> table_;
};

const Curve& decodingCurve();  ///< sRGB-encoded to linear light
const Curve& encodingCurve();  ///< and back

}  // namespace vtm::asset
