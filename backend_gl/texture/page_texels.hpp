/// \file
/// A page of text as texels behind its font's records. Twin of: shaders/texture/sample_page.glsl, which says
/// what stands where.
#pragma once

#include <vector>

#include <vtm/asset/text_page.hpp>
#include "backend_gl/core/gl.hpp"

namespace vtm::gl {

/// `first`: where the first of them will stand. The page must be valid. Throws GlError if more than 255
/// glyphs stand in one place.
std::vector<asset::Texel> pageTexels(const asset::TextPage& page, const asset::AssetView& font, GLuint first);

}  // namespace vtm::gl
