/// \file
/// Bytes of a `.vtm` file as a validated view, without copying its records.
#pragma once

#include <vtm/asset/container.hpp>

namespace vtm::asset {

/// `view` points into the file's bytes and into `images` and `materials`, the only parts that are decoded.
struct Contents {
    AssetView view;
    std::vector<image::Bitmap> images;
    std::vector<Material> materials;
};

/// `bytes` must begin at a multiple of recordAlignment and outlive the contents. Throws FormatError.
Contents openContents(std::span<const std::uint8_t> bytes);
inline constexpr std::size_t recordAlignment = 16;

}  // namespace vtm::asset
