/// \file
/// Paints and paint programs; twin of backend_gl/shaders/shared/paint.glsl.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <vtm/raster/evaluate.hpp>
#include "raster/src/float4.hpp"
#include "raster/src/image_fill.hpp"
#include "raster/steepness.hpp"

namespace vtm::asset {

/// Where a paint is asked for its colour.
struct PaintPlace {
    glm::vec2 point{0};  ///< of the picture
    glm::mat2 pixel{0};  ///< what a step of a pixel in x and in y is there; 0: as if magnified
};

/// An asset's paints, with what they need made once. The asset must outlive it.
class Paints {
public:
    explicit Paints(const AssetView& asset);
    /// With the asset's images, which were made for another one of the same.
    Paints(const AssetView& asset, std::shared_ptr<const Images> images);
    /// Those of a map whose paints begin at `first`, which become numbers from 0; what was made is shared.
    Paints from(std::uint32_t first) const;

    /// Premultiplied.
    glm::vec4 color(std::uint32_t paint, const PaintPlace& place,
                    const MaterialFunction& materials = {}) const;
    /// At places that are `step` apart, of which `place` is the first.
    void colors(std::uint32_t paint, const PaintPlace& place, glm::vec2 step, std::span<Float4> colors,
                const MaterialFunction& materials = {}) const;

    /// At places anywhere, of pixels of one size.
    void colors(std::uint32_t paint, std::span<const glm::vec2> points, const glm::mat2& pixel,
                std::span<Float4> colors, const MaterialFunction& materials = {}) const;

    const AssetView& asset() const { return asset_; }
    const Images& images() const { return *made_->images; }
    const std::shared_ptr<const Images>& sharedImages() const { return made_->images; }
    /// By paint (raster/steepness.hpp).
    std::span<const PaintChange> changes() const { return made_->changes.byPaint().subspan(first_); }
    PaintChange changeNear(std::uint32_t paint, const PixelsNear& pixels) const {
        return made_->changes.near(std::uint32_t(first_) + paint, pixels);
    }
    /// Of gradients: by texel of the asset's data, straight, where a stop stands.
    std::span<const glm::vec4> stopColors() const { return made_->stopColors; }

private:
    template <class Places>
    void run(const Paint& program, Places places, std::span<Float4> colors,
             const MaterialFunction& materials) const;

    struct Made {
        Made(const AssetView& asset, std::shared_ptr<const Images> imagesOf)
            : images(std::move(imagesOf)), changes(asset) {}

        std::shared_ptr<const Images> images;
        PaintChanges changes;
        std::vector<glm::vec4> stopColors;
    };

    AssetView asset_;  ///< its paints are those from the first on
    std::size_t first_ = 0;
    std::shared_ptr<const Made> made_;
};

}  // namespace vtm::asset
