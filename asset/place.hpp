/// \file
/// Maps into assets: maps of one asset appended to another, and placed in a map of it.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "asset/instances.hpp"

namespace vtm::asset {

/// More symbols, instances or maps than the format has numbers for; the message says which.
class TooManyInstances : public std::length_error {
    using std::length_error::length_error;
};

/// One map without instances, and the records of its tree.
Asset extractMap(const AssetView& from, std::uint32_t map);

/// Appends the first map of an asset without instances, and the records of its tree. The paints that it names
/// stay numbers. Returns the map's index. Throws TooManyInstances.
std::uint16_t appendMap(const AssetView& from, Asset& asset);

/// A map at a place of another map.
struct PlacementInSquare {
    std::uint16_t map = 0;
    std::vector<std::uint16_t> paints;  ///< for the numbers of the map: paints[0] is the ground
    Affine2 toSquare;                   ///< from the map's [0, 1]² to that of the map around
};

/// Appends instances in trees, with the symbols and palettes that they need. Returns what becomes
/// Map::instances of the map around; 0 for none. Throws TooManyInstances.
std::uint32_t appendInstances(std::span<const PlacementInSquare> placements, Asset& asset);

/// By how much rounding an instance moves a corner of [0, 1]² at most, along x or y, in sides of the square
/// around: `linear` leads there.
double placementError(const glm::dmat2& linear);

}  // namespace vtm::asset
