#include "api/openvg/draw/pixel_source.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "api/openvg/paint/paint_color.hpp"
#include "api/openvg/state/matrix.hpp"

namespace vtm::openvg {

namespace {

using glm::dvec2;

class ConstantSource final : public PixelSource {
public:
    explicit ConstantSource(Color color) : PixelSource(sRGBA_PRE), color_(color) {}
    void colors(int, int, std::span<Color> colors) const override { std::ranges::fill(colors, color_); }
    std::optional<Color> constant() const override { return color_; }

private:
    Color color_;
};

/// Walks the pixels of a row through a map.
class GradientSource : public PixelSource {
protected:
    GradientSource(ColorSpace space, const glm::dmat3& fromSurface)
        : PixelSource(space),
          fromSurface_(fromSurface),
          isAffine_(fromSurface[0].z == 0 && fromSurface[1].z == 0) {}

    dvec2 at(double x, double y) const {
        const glm::dvec3 p = fromSurface_ * glm::dvec3(x + 0.5, y + 0.5, 1);
        return isAffine_ && p.z == 1 ? dvec2(p) : dvec2(p) / p.z;
    }
    /// From one pixel to the next, if all are equally far from each other.
    bool isAffine() const { return isAffine_; }
    dvec2 step() const { return dvec2(fromSurface_[0]) / fromSurface_[2].z; }

private:
    glm::dmat3 fromSurface_;
    bool isAffine_;
};

class LinearGradientSource final : public GradientSource {
public:
    LinearGradientSource(const Paint& paint, const glm::dmat3& fromSurface)
        : GradientSource({paint.rampLinear, true, false}, fromSurface),
          ramp_(paint),
          start_(paint.linear[0], paint.linear[1]) {
        const dvec2 d = dvec2(paint.linear[2], paint.linear[3]) - start_;
        const double length2 = glm::dot(d, d);
        isPoint_ = !(length2 > 0);
        slope_ = isPoint_ ? dvec2(0) : d / length2;
    }

    void colors(int x, int y, std::span<Color> colors) const override {
        const double first = value(x, y), step = glm::dot(this->step(), slope_);
        for (std::size_t i = 0; i < colors.size(); ++i)
            colors[i] = ramp_.at(isAffine() ? first + double(i) * step : value(x + double(i), y));
    }

private:
    double value(double x, double y) const { return isPoint_ ? 1 : glm::dot(at(x, y) - start_, slope_); }

    ColorRamp ramp_;
    dvec2 start_, slope_;
    bool isPoint_;
};

class RadialGradientSource final : public GradientSource {
public:
    RadialGradientSource(const Paint& paint, const glm::dmat3& fromSurface)
        : GradientSource({paint.rampLinear, true, false}, fromSurface),
          ramp_(paint),
          radius_(paint.radial[4]) {
        center_ = {paint.radial[0], paint.radial[1]};
        focus_ = insideFocus(paint) - center_;
        inverse_ = 1 / (radius_ * radius_ - glm::dot(focus_, focus_));
    }

    void colors(int x, int y, std::span<Color> colors) const override {
        dvec2 d = at(x, y) - center_ - focus_;
        for (std::size_t i = 0; i < colors.size(); ++i) {
            if (!isAffine())
                d = at(x + double(i), y) - center_ - focus_;
            colors[i] = ramp_.at(value(d));
            d += step();
        }
    }

private:
    /// At an offset from the focus.
    double value(dvec2 d) const {
        if (!(radius_ > 0))
            return 1;
        const double across = d.x * focus_.y - d.y * focus_.x, along = glm::dot(d, focus_);
        const double root = std::sqrt(std::max(0.0, radius_ * radius_ * glm::dot(d, d) - across * across));
        return (along + root) * inverse_;
    }

    ColorRamp ramp_;
    dvec2 center_, focus_;  ///< the focus from the centre
    double radius_, inverse_ = 0;
};

// ---- Images ---------------------------------------------------------------------------------------

/// Colours of an image that goes on outside of its borders, premultiplied in its own space.
class Texels {
public:
    Texels(const Image& image, VGTilingMode tiling, const std::array<VGfloat, 4>& fill)
        : image_(image), tiling_(tiling) {
        const ColorSpace own = image.format().space;
        fill_ = givenColor(fill, {own.linear, true, own.luminance});
    }

    const Image& image() const { return image_; }

    Color at(double x, double y) const {
        const int w = image_.width(), h = image_.height();
        if (tiling_ == VG_TILE_FILL && !(x >= 0 && y >= 0 && x < w && y < h))
            return fill_;
        const Color color = image_.color(inside(x, w), inside(y, h));
        return image_.format().space.premultiplied ? color : premultiplied(color);
    }

private:
    /// `v` is whole, or no number.
    int inside(double v, int size) const {
        if (!(std::abs(v) < 1e15))
            return 0;
        if (tiling_ == VG_TILE_REPEAT)
            return int(v - size * std::floor(v / size));
        if (tiling_ == VG_TILE_REFLECT) {
            const double tile = std::floor(v / size);
            const int i = int(v - size * tile);
            return std::fmod(tile, 2) != 0 ? size - 1 - i : i;
        }
        return int(std::clamp(v, 0.0, double(size - 1)));
    }

    const Image& image_;
    VGTilingMode tiling_;
    Color fill_;
};

/// Nearest, bilinear, or where the view minifies the mean of bilinear samples over the pixel's footprint.
class ImageSource final : public PixelSource {
public:
    ImageSource(Texels texels, const glm::dmat3& fromSurface, bool isSmooth)
        : PixelSource({texels.image().format().space.linear, true, texels.image().format().space.luminance}),
          texels_(texels),
          fromSurface_(fromSurface),
          isSmooth_(isSmooth) {}

    void colors(int x, int y, std::span<Color> colors) const override {
        for (std::size_t i = 0; i < colors.size(); ++i)
            colors[i] = color(double(x) + double(i) + 0.5, y + 0.5);
    }

private:
    /// Samples along each side of a pixel's footprint, at most.
    static constexpr int maxSamples = 16;

    dvec2 mapped(double x, double y) const {
        const glm::dvec3 p = fromSurface_ * glm::dvec3(x, y, 1);
        return dvec2(p) / p.z;
    }

    Color color(double x, double y) const {
        const dvec2 p = mapped(x, y);
        if (!isSmooth_)
            return texels_.at(std::floor(p.x), std::floor(p.y));
        const int across = samples(mapped(x + 0.5, y) - mapped(x - 0.5, y)),
                  up = samples(mapped(x, y + 0.5) - mapped(x, y - 0.5));
        if (across == 1 && up == 1)
            return bilinear(p);
        Color sum(0);
        for (int j = 0; j < up; ++j)
            for (int i = 0; i < across; ++i)
                sum += bilinear(mapped(x - 0.5 + (i + 0.5) / across, y - 0.5 + (j + 0.5) / up));
        return sum / float(across * up);
    }

    /// A side longer than a texel is sampled at least once a texel. A little longer is not longer.
    static int samples(dvec2 side) {
        const double length = glm::length(side);
        return length > 1.001 ? int(std::min(std::ceil(length), double(maxSamples))) : 1;
    }

    Color bilinear(dvec2 p) const {
        const dvec2 q = p - 0.5, floor = glm::floor(q), f = q - floor;
        // So far away that there are no places between texels, or nowhere.
        if (f == dvec2(0) || !(std::isfinite(f.x) && std::isfinite(f.y)))
            return texels_.at(floor.x, floor.y);
        const auto mix = [](Color a, Color b, double t) { return a + float(t) * (b - a); };
        return mix(mix(texels_.at(floor.x, floor.y), texels_.at(floor.x + 1, floor.y), f.x),
                   mix(texels_.at(floor.x, floor.y + 1), texels_.at(floor.x + 1, floor.y + 1), f.x), f.y);
    }

    Texels texels_;
    glm::dmat3 fromSurface_;
    bool isSmooth_;
};

class ProductSource final : public PixelSource {
public:
    ProductSource(std::unique_ptr<PixelSource> image, std::unique_ptr<PixelSource> paint)
        : PixelSource({image->space().linear, true, false}),
          image_(std::move(image)),
          paint_(std::move(paint)) {}

    void colors(int x, int y, std::span<Color> colors) const override {
        image_->colors(x, y, colors);
        std::array<Color, 64> paints;
        for (std::size_t done = 0; done < colors.size(); done += paints.size()) {
            const std::size_t count = std::min(paints.size(), colors.size() - done);
            paint_->colors(x + int(done), y, std::span(paints).first(count));
            for (std::size_t i = 0; i < count; ++i)
                colors[done + i] *= paints[i];
        }
    }

private:
    std::unique_ptr<PixelSource> image_, paint_;
};

}  // namespace

glm::dvec2 insideFocus(const Paint& paint) {
    // By a little, so that the gradient has a value everywhere.
    constexpr double maxOff = 0.999;
    const dvec2 center(paint.radial[0], paint.radial[1]), focus(paint.radial[2], paint.radial[3]);
    const double distance = glm::distance(focus, center), maximum = maxOff * double(paint.radial[4]);
    return distance > maximum ? center + (focus - center) * (maximum / distance) : focus;
}

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
    if (paint.type == VG_PAINT_TYPE_LINEAR_GRADIENT)
        return std::make_unique<LinearGradientSource>(paint, *fromSurface);
    if (paint.type == VG_PAINT_TYPE_RADIAL_GRADIENT)
        return std::make_unique<RadialGradientSource>(paint, *fromSurface);
    return transformedSource(
        std::make_unique<ImageSource>(Texels(*paint.pattern, paint.tiling, state.tileFillColor), *fromSurface,
                                      state.imageQuality != VG_IMAGE_QUALITY_NONANTIALIASED),
        ColorTransform(paint));
}

std::unique_ptr<PixelSource> imageSource(const Image& image, const glm::mat3& imageToSurface,
                                         const State& state) {
    const std::optional<glm::dmat3> fromSurface = inverseOf(imageToSurface);
    if (!fromSurface)
        return nullptr;
    return std::make_unique<ImageSource>(Texels(image, VG_TILE_PAD, {}), *fromSurface,
                                         isSmooth(image, state));
}

std::unique_ptr<PixelSource> productSource(std::unique_ptr<PixelSource> image,
                                           std::unique_ptr<PixelSource> paint) {
    return std::make_unique<ProductSource>(std::move(image), std::move(paint));
}

}  // namespace vtm::openvg
