/// \file
/// Instances as vtm_sample finds them: in each map grids whose cells name the instances that they meet, so
/// that a footprint of a pixel asks few. Twin of: shaders/texture/sample_maps.glsl, which says what stands
/// where.
#pragma once

#include <vector>

#include <vtm/asset/asset.hpp>
#include "backend_gl/core/gl.hpp"

namespace vtm::gl {

struct InstanceGrids {
    std::vector<asset::Texel> texels;
    std::vector<GLuint> ofMap;  ///< first texel of each map's first grid; 0: the map has no instances
};

/// `first`: where the first of the texels will stand; more than 0.
InstanceGrids instanceGrids(const asset::AssetView& asset, GLuint first);

}  // namespace vtm::gl
