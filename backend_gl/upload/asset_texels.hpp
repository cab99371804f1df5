/// \file
/// An asset's records as textures for texelFetch, row after row.
#pragma once

#include <cstring>
#include <span>
#include <vector>

#include <vtm/asset/asset.hpp>
#include "backend_gl/core/gl.hpp"

namespace vtm::gl {

/// Returns the first of the records' texels.
template <class Record>
GLuint appendTexels(std::vector<asset::Texel>& texels, std::span<const Record> records) {
    static_assert(sizeof(Record) % sizeof(asset::Texel) == 0);
    const std::size_t first = texels.size();
    texels.resize(first + records.size_bytes() / sizeof(asset::Texel));
    if (!records.empty())
        std::memcpy(static_cast<void*>(texels.data() + first), records.data(), records.size_bytes());
    return GLuint(first);
}

/// All pictures' pixels, each with its levels behind it where a paint reads them.
struct ImageTexels {
    std::vector<asset::Texel> list;  ///< one a picture: its first pixel in `rgba`, width, height, 0
    std::vector<std::uint8_t> rgba;
};
ImageTexels imageTexels(const asset::AssetView& asset);

/// RGBA32UI, 2^texelColumnsLog2 wide. Throws GlError where they are too many.
TextureHandle texelTexture(std::vector<asset::Texel> texels);
/// RGBA8, 2^imageColumnsLog2 wide. Throws likewise.
TextureHandle imageTexture(std::vector<std::uint8_t> rgba);

}  // namespace vtm::gl
