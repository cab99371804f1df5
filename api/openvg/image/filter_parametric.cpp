// VG_KHR_parametric_filter.

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <VG/vgext.h>

#include "api/openvg/image/filter_images.hpp"
#include "api/openvg/paint/paint_color.hpp"

using namespace vtm::openvg;

namespace {

/// highlight() or shadow() of the extension's text.
class Tint {
public:
    /// Colours come premultiplied in `space`.
    Tint(const Context& context, VGPaint handle, float strength, ColorSpace space)
        : strength_(strength), space_(space) {
        if (handle == VG_INVALID_HANDLE)
            return;
        const std::shared_ptr<Paint> paint = context.objects->get<Paint>(handle);
        require(paint->type == VG_PAINT_TYPE_COLOR || paint->type == VG_PAINT_TYPE_LINEAR_GRADIENT);
        if (paint->type == VG_PAINT_TYPE_COLOR) {
            const std::array<VGfloat, 4>& c = paint->color;
            color_ = premultiplied(transformedColor(ColorTransform(*paint), Color(c[0], c[1], c[2], c[3]),
                                                    {space.linear, false, false}));
        } else {
            ramp_.emplace(*paint);
            require(ramp_->first().a == 0);
        }
    }

    /// False for VG_INVALID_HANDLE.
    bool exists() const { return color_ || ramp_; }

    /// 0 without a paint. Alphas times the strength are alphas again: no more than 1.
    Color operator()(float alpha) const {
        const float amount = std::min(std::max(0.0f, alpha * strength_), 1.0f);
        if (color_)
            return *color_ * amount;
        return ramp_ ? fullyConverted(ramp_->at(double(amount)), ramp_->space(), space_) : Color(0);
    }

private:
    float strength_;
    ColorSpace space_;
    std::optional<Color> color_;
    std::optional<ColorRamp> ramp_;
};

/// Between two pixels of a line.
struct Between {
    int low, high;
    float share;

    /// Whole numbers are pixels. max first: it makes 0 of NaN.
    Between(double v, int size) {
        const double inside = std::min(std::max(0.0, v), size - 1.0);
        low = int(inside);
        high = std::min(low + 1, size - 1);
        share = float(inside - low);
    }
    float mix(float a, float b) const { return a + share * (b - a); }
};

/// An image's alpha, moved by an offset and interpolated, its border pixels going on outside.
class MovedAlphas {
public:
    MovedAlphas(const Raster& image, double dx, double dy, int width)
        : image_(image), dy_(dy), line_(std::size_t(image.width)), row_(std::size_t(width)) {
        for (int x = 0; x < width; ++x)
            places_.emplace_back(x + dx, image.width);
    }

    const std::vector<float>& row(int y) {
        const Between v(y + dy_, image_.height);
        for (int x = 0; x < image_.width; ++x)
            line_[std::size_t(x)] = v.mix(image_.at(x, v.low).a, image_.at(x, v.high).a);
        for (std::size_t x = 0; x < row_.size(); ++x) {
            const Between& u = places_[x];
            row_[x] = u.mix(line_[std::size_t(u.low)], line_[std::size_t(u.high)]);
        }
        return row_;
    }

private:
    const Raster& image_;
    const double dy_;
    std::vector<Between> places_;
    std::vector<float> line_, row_;
};

Color sum(Color a, Color b) { return glm::min(a + b, 1.0f); }

}  // namespace

void vgParametricFilterKHR(VGImage dst, VGImage src, VGImage blur, VGfloat strength, VGfloat offsetX,
                           VGfloat offsetY, VGbitfield filterFlags, VGPaint highlightPaint,
                           VGPaint shadowPaint) {
    call([&](Context& context) {
        for (const VGImage image : {dst, src, blur})
            context.objects->get<Image>(image);
        for (const VGPaint paint : {highlightPaint, shadowPaint})
            if (paint != VG_INVALID_HANDLE)
                context.objects->get<Paint>(paint);
        const FilterImages images(context, dst, src), blurred(context, dst, blur);
        const ColorSpace space{context.state.filterFormatLinear, true, false};
        const Tint highlight(context, highlightPaint, strength, space),
            shadow(context, shadowPaint, strength, space);
        const bool isInner = filterFlags & VG_PF_INNER_FLAG_KHR, isOuter = filterFlags & VG_PF_OUTER_FLAG_KHR,
                   knocksOut = filterFlags & VG_PF_KNOCKOUT_FLAG_KHR,
                   isVisible = filterFlags & VG_PF_OBJECT_VISIBLE_FLAG_KHR;
        Raster blurs(blurred.src->width(), blurred.src->height());
        for (int y = 0; y < blurs.height; ++y)
            decodeRow(blurred.src->format(), blurred.src->at(0, y), blurs.row(y));
        const double dx = double(offsetX), dy = double(offsetY);
        MovedAlphas towards(blurs, dx, dy, images.width()), away(blurs, -dx, -dy, images.width());
        std::vector<Color> row(std::size_t(images.src->width()));
        const std::span<Color> colors = std::span(row).first(std::size_t(images.width()));
        for (int y = 0; y < images.height(); ++y) {
            normalizedRow(*images.src, y, space, row);
            const std::vector<float>&ahead = towards.row(y), &behind = away.row(y);
            for (int x = 0; x < images.width(); ++x) {
                // A paint that is not there has no light to take from the other's: glows and drop shadows.
                const float lit = highlight.exists() ? ahead[std::size_t(x)] : 0,
                            shaded = shadow.exists() ? behind[std::size_t(x)] : 0;
                const Color outer =
                    sum(highlight(std::max(lit - shaded, 0.0f)), shadow(std::max(shaded - lit, 0.0f)));
                const Color inner = highlight.exists() ? outer : shadow(1 - std::max(shaded - lit, 0.0f));

                const Color object = colors[std::size_t(x)];
                const float innerAlpha = isInner ? object.a : 0,
                            objectAlpha = knocksOut || !isVisible ? 0
                                          : isInner               ? 1 - inner.a
                                                                  : 1,
                            outerAlpha = !isOuter                 ? 0
                                         : knocksOut || isVisible ? 1 - object.a
                                                                  : 1;
                colors[std::size_t(x)] =
                    sum(sum(inner * innerAlpha, object * objectAlpha), outer * outerAlpha);
            }
            writeFilteredRow(context.state, *images.dst, y, colors, space);
        }
    });
}
