#include "svg/convert/filter_matrix.hpp"

#include <cmath>
#include <numbers>

namespace vtm::svg {
namespace {

/// The luminance of linear light, rounded as the specification has it.
constexpr double red = 0.213, green = 0.715, blue = 0.072;

}  // namespace

scene::ColorMatrixFilter matrixOf(const std::array<double, 9>& c) {
    scene::ColorMatrixFilter filter;
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 3; ++column)
            filter.matrix[row * 5 + column] = static_cast<float>(c[row * 3 + column]);
    filter.matrix[18] = 1;
    return filter;
}

scene::ColorMatrixFilter saturateMatrix(double s) {
    return matrixOf({red + (1 - red) * s, green - green * s, blue - blue * s, red - red * s,
                     green + (1 - green) * s, blue - blue * s, red - red * s, green - green * s,
                     blue + (1 - blue) * s});
}

scene::ColorMatrixFilter grayscaleMatrix(double amount) {
    const double r = 1 - amount;
    return matrixOf({0.2126 + 0.7874 * r, 0.7152 - 0.7152 * r, 0.0722 - 0.0722 * r, 0.2126 - 0.2126 * r,
                     0.7152 + 0.2848 * r, 0.0722 - 0.0722 * r, 0.2126 - 0.2126 * r, 0.7152 - 0.7152 * r,
                     0.0722 + 0.9278 * r});
}

scene::ColorMatrixFilter hueRotateMatrix(double degrees) {
    const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
    return matrixOf(
        {red + c * (1 - red) - s * red, green - c * green - s * green, blue - c * blue + s * (1 - blue),
         red - c * red + s * 0.143, green + c * (1 - green) + s * 0.140, blue - c * blue - s * 0.283,
         red - c * red - s * (1 - red), green - c * green + s * green, blue + c * (1 - blue) + s * blue});
}

scene::ColorMatrixFilter luminanceToAlphaMatrix() {
    scene::ColorMatrixFilter filter;
    filter.matrix[15] = 0.2125f;
    filter.matrix[16] = 0.7154f;
    filter.matrix[17] = 0.0721f;
    return filter;
}

}  // namespace vtm::svg
