/// \file
/// Integrals of gradients' ramps from stop to stop, so that a pixel over many stops needs no loop over them.
#pragma once

#include <vector>

#include <vtm/asset/asset.hpp>

namespace vtm::gl {

/// Beside each texel of the data, if any gradient has more than `longRamp` stops; else nothing. At stop j
/// less at stop i of one gradient it is the premultiplied ramp's integral between them, red, green, blue,
/// alpha in steps of 2^-31, modulo 2^32: a difference is exact, however small it is beside the sum.
std::vector<asset::Texel> rampSums(const asset::AssetView& asset);

/// Whether there are such gradients.
bool hasLongRamps(const asset::AssetView& asset);

}  // namespace vtm::gl
