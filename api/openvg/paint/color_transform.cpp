#include "api/openvg/paint/color_transform.hpp"

#include <algorithm>

namespace vtm::openvg {

namespace {

class TransformedSource final : public PixelSource {
public:
    TransformedSource(std::unique_ptr<PixelSource> source, const ColorTransform& transform)
        : PixelSource({transform.space().linear, true, false}),
          source_(std::move(source)),
          transform_(transform) {}

    void colors(int x, int y, std::span<Color> colors) const override {
        source_->colors(x, y, colors);
        for (Color& color : colors)
            color = premultiplied(
                transform_(converted(unpremultiplied(color), source_->space(), transform_.space())));
    }

private:
    std::unique_ptr<PixelSource> source_;
    ColorTransform transform_;
};

}  // namespace

ScaleAndBias::ScaleAndBias(const State& state) : isOn_(state.colorTransform) {
    for (int c = 0; c < 4; ++c) {
        scale_[c] = std::clamp(state.colorTransformValues[std::size_t(c)], -127.0f, 127.0f);
        bias_[c] = std::clamp(state.colorTransformValues[std::size_t(4 + c)], -1.0f, 1.0f);
    }
}

ColorTransform::ColorTransform(const Paint& paint)
    : space_{paint.transformLinear, false, false}, isIdentity_(paint.colorMatrix == Paint::identityMatrix) {
    const std::array<VGfloat, 20>& m = paint.colorMatrix;
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            matrix_[c][r] = m[std::size_t(4 * c + r)];
    added_ = {m[16], m[17], m[18], m[19]};
}

Color ColorTransform::operator()(Color color) const {
    // max first: it makes 0 of what is no number.
    return glm::min(glm::max(Color(0), matrix_ * color + added_), 1.0f);
}

Color transformedColor(const ColorTransform& transform, Color color, ColorSpace to) {
    color = clampedToUnit(color);
    if (transform.isIdentity())
        return converted(color, sRGBA, to);
    return converted(transform(converted(color, sRGBA, transform.space())), transform.space(), to);
}

std::unique_ptr<PixelSource> transformedSource(std::unique_ptr<PixelSource> source,
                                               const ColorTransform& transform) {
    if (!source || transform.isIdentity())
        return source;
    return std::make_unique<TransformedSource>(std::move(source), transform);
}

}  // namespace vtm::openvg
