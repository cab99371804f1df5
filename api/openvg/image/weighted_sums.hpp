/// \file
/// Sums of colours in doubles: kernels may cancel what they magnify.
#pragma once

#include <span>

#include <glm/vec4.hpp>

namespace vtm::openvg {

using Sum = glm::dvec4;

/// sums[i] = Σ weights[k] * taps[k][i], in the order of k. Results are the same on all processors.
void weightedSums(std::span<const Sum* const> taps, std::span<const double> weights, std::span<Sum> sums);

}  // namespace vtm::openvg
