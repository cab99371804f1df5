/// \file
/// How many turns of loops a pixel may take, and what paints take. llvmpipe ends every loop of an invocation
/// once all of them together have made 65 535 turns; what they had not added yet is lost, as holes in the
/// picture. So whatever is drawn is counted before it is drawn (docs/backend.md).
#pragma once

#include <cstdint>
#include <vector>

#include <vtm/asset/asset.hpp>

namespace vtm::gl {

/// Mesa's LP_MAX_TGSI_LOOP_ITERATIONS: turns of all loops of one invocation.
inline constexpr std::uint32_t driverTurns = 65535;
/// Pixels that share an invocation: 512 bits of floats, the widest vectors that Mesa uses. A loop of a vector
/// turns while a loop of one of its pixels does, so a vector takes at most the turns of all its pixels.
inline constexpr std::uint32_t vectorPixels = 16;
/// What a pixel may take on every driver, whatever its neighbours do.
inline constexpr std::uint32_t turnsPerPixel = driverTurns / vectorPixels;

/// Ramps of more stops are integrated by sums from stop to stop (backend_gl/upload/asset_texels.hpp) instead
/// of a loop over the stops.
inline constexpr std::uint32_t longRamp = 16;

/// Images take what their pixels' footprints want: as many as at most, or none, where shaders count them.
enum class ImageTurns { AtMost, CountedByShaders };

/// The turns that paint.glsl takes for one colour of a paint at most, by paint: 0 for solid colours. Loops in
/// materials are their authors' own.
std::vector<std::uint32_t> programTurns(const asset::AssetView& asset,
                                        ImageTurns images = ImageTurns::AtMost);

}  // namespace vtm::gl
