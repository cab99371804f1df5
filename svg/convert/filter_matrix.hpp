/// \file
/// Colour matrices that have names. Source: Filter Effects Module Level 1, section 9.6.
#pragma once

#include <array>

#include <vtm/scene/filter.hpp>

namespace vtm::svg {

/// Of red, green and blue, row by row.
scene::ColorMatrixFilter matrixOf(const std::array<double, 9>& colors);
scene::ColorMatrixFilter saturateMatrix(double amount);
scene::ColorMatrixFilter grayscaleMatrix(double amount);
scene::ColorMatrixFilter hueRotateMatrix(double degrees);
scene::ColorMatrixFilter luminanceToAlphaMatrix();

}  // namespace vtm::svg
