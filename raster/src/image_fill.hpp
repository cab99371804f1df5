/// \file
/// Images of paint programs; twin of backend_gl/shaders/shared/image.glsl.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <vtm/asset/asset.hpp>
#include "image/levels.hpp"

namespace vtm::asset {

/// An asset's images with those of their levels that its paints read. The asset must outlive it.
class Images {
public:
    explicit Images(const AssetView& asset);

    /// Premultiplied colour of a fill at a picture point; `pixel`: what a step of a pixel in x and in y is in
    /// the picture.
    glm::vec4 color(const ImageFill& fill, glm::vec2 point, const glm::mat2& pixel) const;

private:
    struct LeveledImage {
        const image::Bitmap* bitmap;
        std::vector<image::Level> levels;
    };
    std::vector<LeveledImage> pictures_;
};

}  // namespace vtm::asset
