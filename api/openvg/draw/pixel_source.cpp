#include "api/openvg/draw/pixel_source.hpp"

#include <algorithm>
#include <array>

#include "api/openvg/draw/gradient_source.hpp"
#include "api/openvg/draw/source_description.hpp"
#include "api/openvg/draw/texel_source.hpp"
#include "api/openvg/image/pixel_rows.hpp"
#include "api/openvg/paint/paint_color.hpp"
#include "api/openvg/state/matrix.hpp"

namespace vtm::openvg {

namespace {

class ConstantSource final : public PixelSource {
public:
    explicit ConstantSource(Color color) : PixelSource(sRGBA_PRE), color_(color) {}
    void colors(int, int, std::span<Color> colors) const override { std::ranges::fill(colors, color_); }
    std::optional<Color> constant() const override { return color_; }
    bool describe(SourceDescription& d) const override {
        d.colors = color_;
        d.colorSpace = d.space = space();
        return true;
    }

private:
    Color color_;
};

class ProductSource final : public PixelSource {
public:
    ProductSource(std::unique_ptr<PixelSource> image, std::unique_ptr<PixelSource> paint)
        : PixelSource({image->space().linear, true, false}),
          image_(std::move(image)),
          paint_(std::move(paint)) {}

    void colors(int x, int y, std::span<Color> colors) const override {
        image_->colors(x, y, colors);
        std::array<Color, rowChunk> paints;
        inChunks(int(colors.size()), [&](int first, int count) {
            paint_->colors(x + first, y, std::span(paints).first(std::size_t(count)));
            for (int i = 0; i < count; ++i)
                colors[std::size_t(first + i)] *= paints[std::size_t(i)];
        });
    }

    bool describe(SourceDescription& d) const override {
        SourceDescription factor;
        if (!image_->describe(factor) || !paint_->describe(d))
            return false;
        const auto* const texels = std::get_if<TexelField>(&factor.colors);
        if (!texels || factor.transform)
            return false;
        d.factor = *texels;
        d.space = space();
        return true;
    }

private:
    std::unique_ptr<PixelSource> image_, paint_;
};

}  // namespace

bool isSmooth(const Image& image, const State& state) {
    return (state.imageQuality == VG_IMAGE_QUALITY_BETTER &&
            image.allowedQuality & (VG_IMAGE_QUALITY_BETTER | VG_IMAGE_QUALITY_FASTER)) ||
           (state.imageQuality == VG_IMAGE_QUALITY_FASTER && image.allowedQuality & VG_IMAGE_QUALITY_FASTER);
}

std::unique_ptr<PixelSource> constantSource(Color color) { return std::make_unique<ConstantSource>(color); }

const Paint& currentPaint(const State& state, VGPaintMode mode) {
    static const Paint defaults;
    const std::shared_ptr<Paint>& paint = mode == VG_STROKE_PATH ? state.strokePaint : state.fillPaint;
    return paint ? *paint : defaults;
}

std::unique_ptr<PixelSource> paintSource(const Paint& paint, const glm::mat3& paintToSurface,
                                         const State& state) {
    if (paint.type == VG_PAINT_TYPE_COLOR || (paint.type == VG_PAINT_TYPE_PATTERN && !paint.pattern)) {
        const std::array<VGfloat, 4>& c = paint.color;
        return constantSource(
            premultiplied(transformedColor(ColorTransform(paint), Color(c[0], c[1], c[2], c[3]), sRGBA)));
    }
    const std::optional<glm::dmat3> fromSurface = inverseOf(paintToSurface);
    if (!fromSurface)
        return nullptr;
    if (paint.type != VG_PAINT_TYPE_PATTERN)
        return gradientSource(paint, *fromSurface);
    return transformedSource(texelSource({*paint.pattern, paint.tiling, state.tileFillColor}, *fromSurface,
                                         state.imageQuality != VG_IMAGE_QUALITY_NONANTIALIASED),
                             ColorTransform(paint));
}

std::unique_ptr<PixelSource> imageSource(const Image& image, const glm::mat3& imageToSurface,
                                         const State& state) {
    const std::optional<glm::dmat3> fromSurface = inverseOf(imageToSurface);
    if (!fromSurface)
        return nullptr;
    return texelSource({image, VG_TILE_PAD, {}}, *fromSurface, isSmooth(image, state));
}

std::unique_ptr<PixelSource> productSource(std::unique_ptr<PixelSource> image,
                                           std::unique_ptr<PixelSource> paint) {
    return std::make_unique<ProductSource>(std::move(image), std::move(paint));
}

}  // namespace vtm::openvg
