#include "raster/pixel_paints.hpp"

#include <utility>

#include <glm/matrix.hpp>

#include "raster/src/paint.hpp"
#include "raster/steepness.hpp"

namespace vtm::asset {

struct PixelPaints::Impl {
    Paints paints;
    glm::dvec2 offset;
    glm::dmat2 toPicture;
    float minSteep;

    glm::vec2 point(const glm::dvec2& pixel) const { return {toPicture * (pixel - offset)}; }
};

PixelPaints::PixelPaints(const AssetView& asset, std::shared_ptr<const Images> images, const View& view) {
    const glm::dmat2 toPicture = glm::inverse(glm::dmat2(view.toPixels));
    impl_.reset(
        new Impl{Paints(asset, std::move(images)), view.toPixels[2], toPicture, minSteepness(toPicture)});
}
PixelPaints::~PixelPaints() = default;

bool PixelPaints::isSteep(std::uint32_t paint) const {
    return impl_->paints.changes()[paint].steepness > impl_->minSteep;
}

glm::vec4 PixelPaints::color(std::uint32_t paint, int x, int row) const {
    return impl_->paints.color(paint, {impl_->point({x + 0.5, row + 0.5}), glm::mat2(impl_->toPicture)});
}

std::array<glm::vec4, 4> PixelPaints::quarters(std::uint32_t paint, int x, int row) const {
    const glm::vec2 points[]{impl_->point({x + 0.25, row + 0.25}), impl_->point({x + 0.75, row + 0.25}),
                             impl_->point({x + 0.25, row + 0.75}), impl_->point({x + 0.75, row + 0.75})};
    std::array<Float4, 4> colors;
    impl_->paints.colors(paint, points, glm::mat2(0.5 * impl_->toPicture), colors);
    return {toVec4(colors[0]), toVec4(colors[1]), toVec4(colors[2]), toVec4(colors[3])};
}

}  // namespace vtm::asset
