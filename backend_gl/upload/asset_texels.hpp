/// \file
/// An asset's records as textures for texelFetch, row after row; beside its data, integrals of gradients'
/// ramps from stop to stop, so that a pixel over many stops needs no loop over them.
#pragma once

#include <cstring>
#include <span>
#include <string>
#include <vector>

#include <vtm/asset/asset.hpp>
#include "backend_gl/core/gl.hpp"
#include "backend_gl/sampled_data.hpp"

namespace vtm::gl {

/// Returns the first of the records' texels. Small records share texels; the last one is filled up with
/// zeros.
template <class Record>
GLuint appendTexels(std::vector<asset::Texel>& texels, std::span<const Record> records) {
    const std::size_t first = texels.size(), size = sizeof(asset::Texel);
    static_assert(sizeof(Record) % sizeof(asset::Texel) == 0 || sizeof(asset::Texel) % sizeof(Record) == 0);
    texels.resize(first + (records.size_bytes() + size - 1) / size);
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
/// Changes texels of such a texture from `first` on: those only are sent.
void updateTexels(GLuint texture, std::size_t first, std::span<const asset::Texel> texels);
/// Such a texture of records that are brought up to date.
class RecordTexture {
public:
    RecordTexture() = default;
    explicit RecordTexture(std::vector<asset::Texel> records);

    /// Sends those that differ from the ones of the update before, as long as they fit; everything the first
    /// time, and what was sent before is kept from then on. Returns the bytes sent.
    std::size_t update(std::vector<asset::Texel> next);
    const TextureHandle& texture() const { return texture_; }
    /// That the texture holds.
    std::size_t bytes() const { return room_ * sizeof(asset::Texel); }

private:
    TextureHandle texture_;
    std::size_t room_ = 0;               ///< texels that it holds
    std::vector<asset::Texel> records_;  ///< those of the last update
};
/// RGBA8, 2^imageColumnsLog2 wide. Throws likewise.
TextureHandle imageTexture(std::vector<std::uint8_t> rgba);

/// The same textures as data.
TextureData texelData(std::string name, std::span<const asset::Texel> texels);
TextureData imageData(std::string name, std::span<const std::uint8_t> rgba);

/// Beside each texel of the data, if any gradient has more than `longRamp` stops; else nothing. At stop j
/// less at stop i of one gradient it is the premultiplied ramp's integral between them, red, green, blue,
/// alpha in steps of 2^-31, modulo 2^32: a difference is exact, however small it is beside the sum.
std::vector<asset::Texel> rampSums(const asset::AssetView& asset);

/// Whether there are such gradients.
bool hasLongRamps(const asset::AssetView& asset);

}  // namespace vtm::gl
