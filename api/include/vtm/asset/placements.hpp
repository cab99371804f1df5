/// \file
/// The maps that are placed in a picture, to be moved, recoloured or exchanged without compiling: an
/// animation changes a list of placements and sends it to a texture (vtm/gl/sampled_texture.hpp, update).
/// Source: Ray et al. 2005, dynamic Vector Texture Maps. docs/instances.md.
///
///     auto scene = vtm::compiler::compile(background).asset;
///     auto ball = vtm::asset::addPicture(scene, vtm::compiler::compile(ballScene).asset);
///     std::vector<vtm::asset::Placement> balls(1000, ball);
///     ...                                                     // each frame: balls[i].toPicture = ...
///     texture.update(vtm::asset::withPlacements(scene, balls));
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/mat3x2.hpp>

#include <vtm/asset/asset.hpp>

#pragma GCC visibility push(default)

namespace vtm::asset {

/// A map where it stands in a picture.
struct Placement {
    std::uint32_t map = 0;  ///< of Asset::maps
    /// Asset::paints for the numbers that the map names. paints[0] is the ground: what is drawn around and
    /// below the map's regions. It must be one paint all over them, and regions of two placements must not
    /// overlap, or pixels show wrong colours (docs/instances.md); nothing else can go wrong.
    std::vector<std::uint16_t> paints;
    glm::dmat3x2 toPicture{1};  ///< from the map's square, as [0, 1]², to the picture; regular
};

/// What is placed in the picture that the asset's only command draws, not in other maps. In the order of
/// Asset::instances.
std::vector<Placement> placementsOf(const AssetView& asset);

/// A copy of the asset with these in place of its own. Placements that lie beyond the picture are left out.
/// Where they enlarge a map, Asset::finestPixel grows as much. Throws std::invalid_argument, which names the
/// placement, if the asset has not one map to draw, a map or a paint is missing, a matrix is singular, the
/// middle of a map lies outside the picture's square while a part of it is seen, or the format cannot hold
/// them.
Asset withPlacements(const AssetView& asset, std::span<const Placement> placements);

/// Adds a picture's only map to another asset, where it is to be placed, and its paints. Returns a placement
/// of it at its own size, its corner at (0, 0), over paint 0. Throws std::invalid_argument unless the picture
/// is one map without instances, of solid paints.
Placement addPicture(Asset& asset, const AssetView& picture);

}  // namespace vtm::asset

#pragma GCC visibility pop
