/// \file
/// The files of backend_gl/shaders as strings; embed.cmake writes the definitions at build time.
#pragma once

#include <string_view>

namespace vtm::gl::shaders {

extern const std::string_view prelude;
extern const std::string_view fetch, coverage, blend, gradient, image, paint, placed_paints, leaf_integral;
extern const std::string_view shadow, place, shares, plain_paint, tile_plain_fragment, plain_flat_fragment,
    cell, block_vertex, tile_fragment, tile_programs_fragment;
extern const std::string_view flat_vertex, flat_fragment;
extern const std::string_view leaf_vertex, leaf_placement, solid_fragment, pieces_fragment;
extern const std::string_view sample_asset, sample_prefilter, sample_tree, sample_maps, sample_page, sample,
    mean_fragment, coarser_fragment;
extern const std::string_view box_vertex, fill_fragment, layer_fragment, blend_fragment;
extern const std::string_view layer, store, colors, numbers;
extern const std::string_view source_fragment, per_pixel_fragment, blur_fragment, extreme_fragment,
    move_fragment, convolve_fragment, light_fragment, turbulence_fragment, result_fragment;
extern const std::string_view output, compose_fragment, screen_vertex, id_fragment, work_fragment;

}  // namespace vtm::gl::shaders
