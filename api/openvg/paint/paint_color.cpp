#include "api/openvg/paint/paint_color.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "api/openvg/draw/source_description.hpp"
#include "api/openvg/paint/lanes.hpp"

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

    bool describe(SourceDescription& d) const override {
        if (!source_->describe(d) || d.transform)
            return false;
        d.transform = transform_;
        d.space = space();
        return true;
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

ColorRamp::ColorRamp(const Paint& paint)
    : space_{paint.rampLinear, true, false}, spread_(paint.spread), premultiplied_(paint.rampPremultiplied) {
    const std::vector<VGfloat>& v = paint.stops;
    float last = -1;
    for (std::size_t i = 0; i + 5 <= v.size(); i += 5) {
        const float offset = v[i];
        if (!(offset >= 0 && offset <= 1))
            continue;
        if (offset < last) {
            // Out of order: the whole sequence counts for nothing.
            stops_.clear();
            break;
        }
        last = offset;
        stops_.push_back({offset, Color(v[i + 1], v[i + 2], v[i + 3], v[i + 4])});
    }
    if (stops_.empty())
        stops_ = {{0, Color(0, 0, 0, 1)}, {1, Color(1)}};
    const ColorTransform transform(paint);
    for (Stop& stop : stops_) {
        stop.color = transformedColor(transform, stop.color, {paint.rampLinear, false, false});
        if (premultiplied_)
            stop.color = premultiplied(stop.color);
    }
    if (stops_.front().offset > 0)
        stops_.insert(stops_.begin(), {0, stops_.front().color});
    if (stops_.back().offset < 1)
        stops_.push_back({1, stops_.back().color});
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const Color none(0);
    pieces_.push_back({-infinity, 0, 0, 0, stops_.front().color, none});
    for (std::size_t i = 0; i + 1 < stops_.size(); ++i) {
        const Stop &a = stops_[i], &b = stops_[i + 1];
        const double low = double(a.offset), high = double(b.offset);
        if (low < high)
            pieces_.push_back({low, high, low, 1 / (high - low), a.color, b.color - a.color});
    }
    pieces_.push_back({1, infinity, 0, 0, stops_.back().color, none});
}

const ColorRamp::Piece& ColorRamp::pieceAt(double offset) const {
    return *(std::ranges::upper_bound(pieces_, offset, {}, &Piece::low) - 1);
}

template <bool premultiplies, class Spread>
void ColorRamp::walk(std::span<const double> offsets, std::span<Color> colors, Spread&& spread) const {
    // Neighbours are mostly of one piece.
    const Piece* piece = &pieces_.front();
    Float4 start = loaded(piece->start), change = loaded(piece->change);
    for (std::size_t i = 0; i < offsets.size(); ++i) {
        const double v = spread(offsets[i]);
        if (!(v >= piece->low && v < piece->high)) {
            piece = &pieceAt(v);
            start = loaded(piece->start);
            change = loaded(piece->change);
        }
        const Float4 color = start + splat(float((v - piece->origin) * piece->scale)) * change;
        assign(colors[i], premultiplies ? premultiplied(color) : color);
    }
}

namespace {

/// Beyond, doubles have no fraction; NaN is 0.
double bounded(double v) {
    constexpr double limit = 1e15;
    return std::isnan(v) ? 0 : std::clamp(v, -limit, limit);
}

}  // namespace

void ColorRamp::row(std::span<const double> offsets, std::span<Color> colors) const {
    const auto whole = [](double v) {
        const auto i = std::int64_t(v);
        return i - (double(i) > v);
    };
    const auto with = [&](auto&& spread) {
        premultiplied_ ? walk<false>(offsets, colors, spread) : walk<true>(offsets, colors, spread);
    };
    if (spread_ == VG_COLOR_RAMP_SPREAD_PAD)
        with(bounded);
    else if (spread_ == VG_COLOR_RAMP_SPREAD_REFLECT)
        with([&](double offset) {
            const double v = bounded(offset);
            const std::int64_t i = whole(v);
            return i & 1 ? 1 - (v - double(i)) : v - double(i);
        });
    else
        with([&](double offset) {
            const double v = bounded(offset);
            return v - double(whole(v));
        });
}

}  // namespace vtm::openvg
