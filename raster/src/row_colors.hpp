/// \file
/// Colours of the pixels of a row as a polynomial of second degree: what gradients look like along rows.
#pragma once

#include <array>
#include <cstddef>

#include "raster/src/float4.hpp"

namespace vtm::asset {

/// Colours of pixels of a row: of the i-th, color + i slope + i² bend.
struct RowColors {
    Float4 color{}, slope{}, bend{};
    int degree = 0;  ///< 0 where there are neither slope nor bend, 1 where there is no bend, or 2

    Float4 at(float i) const { return color + i * (slope + i * bend); }
    RowColors scaled(float factor) const { return {factor * color, factor * slope, factor * bend, degree}; }
};

/// The colours of a row, four pixels at a time.
template <bool isStraight>
class ColorSteps {
public:
    explicit ColorSteps(const RowColors& row) : bend_(32 * row.bend) {
        for (int k = 0; k < 4; ++k) {
            colors[std::size_t(k)] = row.at(float(k));
            steps_[std::size_t(k)] = 4 * row.slope;
            if constexpr (!isStraight)
                steps_[std::size_t(k)] += float(8 * k + 16) * row.bend;
        }
    }

    void next() {
        for (std::size_t k = 0; k < 4; ++k) {
            colors[k] += steps_[isStraight ? 0 : k];
            if constexpr (!isStraight)
                steps_[k] += bend_;
        }
    }

    std::array<Float4, 4> colors;

private:
    std::array<Float4, 4> steps_;
    const Float4 bend_;
};

}  // namespace vtm::asset
