#include "api/openvg/draw/gradient_source.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "api/openvg/draw/source_description.hpp"
#include "api/openvg/image/pixel_rows.hpp"
#include "api/openvg/paint/paint_color.hpp"

namespace vtm::openvg {

namespace {

using glm::dvec2;

/// The paint's coordinates at pixel centres.
class RowMap {
public:
    explicit RowMap(const glm::dmat3& fromSurface)
        : fromSurface_(fromSurface),
          isAffine_(fromSurface[0].z == 0 && fromSurface[1].z == 0),
          step_(dvec2(fromSurface[0]) / fromSurface[2].z) {}

    dvec2 at(double x, double y) const {
        const glm::dvec3 p = fromSurface_ * glm::dvec3(x + 0.5, y + 0.5, 1);
        return isAffine_ && p.z == 1 ? dvec2(p) : dvec2(p) / p.z;
    }
    /// From one pixel to the next, if all are equally far from each other.
    bool isAffine() const { return isAffine_; }
    dvec2 step() const { return step_; }
    const glm::dmat3& fromSurface() const { return fromSurface_; }

private:
    glm::dmat3 fromSurface_;
    bool isAffine_;
    dvec2 step_;
};

/// The gradient's values, row by row, through a colour ramp. `Function` has value(dvec2), and rows of places
/// that are equally far from each other.
template <class Function>
class GradientSource final : public PixelSource {
public:
    GradientSource(const Paint& paint, const glm::dmat3& fromSurface)
        : PixelSource({paint.rampLinear, true, false}), map_(fromSurface), function_(paint), ramp_(paint) {}

    void colors(int x, int y, std::span<Color> colors) const override {
        std::array<double, rowChunk> buffer;
        inChunks(int(colors.size()), [&](int first, int count) {
            const std::span<double> values = std::span(buffer).first(std::size_t(count));
            const double left = double(x) + first;
            if (map_.isAffine())
                function_.row(map_.at(left, y), map_.step(), values);
            else
                for (int i = 0; i < count; ++i)
                    values[std::size_t(i)] = function_.value(map_.at(left + i, y));
            ramp_.row(values, colors.subspan(std::size_t(first), std::size_t(count)));
        });
    }

    bool describe(SourceDescription& d) const override {
        d.colorSpace = d.space = space();
        if (function_.isPoint())
            d.colors = ramp_.at(1);
        else
            d.colors = function_.field(map_.fromSurface(), ramp_);
        return true;
    }

private:
    RowMap map_;
    Function function_;
    ColorRamp ramp_;
};

class Linear {
public:
    explicit Linear(const Paint& paint) : start_(paint.linear[0], paint.linear[1]) {
        const dvec2 d = dvec2(paint.linear[2], paint.linear[3]) - start_;
        const double length2 = glm::dot(d, d);
        isPoint_ = !(length2 > 0);
        slope_ = isPoint_ ? dvec2(0) : d / length2;
    }

    double value(dvec2 p) const { return isPoint_ ? 1 : glm::dot(p - start_, slope_); }
    void row(dvec2 first, dvec2 step, std::span<double> values) const {
        const double start = value(first), rise = glm::dot(step, slope_);
        for (int i = 0; i < int(values.size()); ++i)
            values[std::size_t(i)] = start + i * rise;
    }

    bool isPoint() const { return isPoint_; }
    LinearField field(const glm::dmat3& fromSurface, const ColorRamp& ramp) const {
        return {fromSurface, start_, slope_, &ramp};
    }

private:
    dvec2 start_, slope_;
    bool isPoint_;
};

class Radial {
public:
    explicit Radial(const Paint& paint)
        : center_(paint.radial[0], paint.radial[1]),
          focus_(insideFocus(paint) - center_),
          radius2_(double(paint.radial[4]) * double(paint.radial[4])),
          isPoint_(!(paint.radial[4] > 0)),
          inverse_(1 / (radius2_ - glm::dot(focus_, focus_))) {}

    double value(dvec2 p) const { return isPoint_ ? 1 : fromFocus(p - center_ - focus_); }
    void row(dvec2 first, dvec2 step, std::span<double> values) const {
        if (isPoint_) {
            std::ranges::fill(values, 1);
            return;
        }
        const dvec2 start = first - center_ - focus_;
        for (int i = 0; i < int(values.size()); ++i)
            values[std::size_t(i)] = fromFocus({start.x + i * step.x, start.y + i * step.y});
    }

    bool isPoint() const { return isPoint_; }
    RadialField field(const glm::dmat3& fromSurface, const ColorRamp& ramp) const {
        return {fromSurface, center_ + focus_, focus_, radius2_, &ramp};
    }

private:
    double fromFocus(dvec2 d) const {
        const double across = d.x * focus_.y - d.y * focus_.x, along = d.x * focus_.x + d.y * focus_.y,
                     square = radius2_ * (d.x * d.x + d.y * d.y) - across * across;
        return (along + std::sqrt(square > 0 ? square : 0)) * inverse_;
    }

    dvec2 center_, focus_;  ///< the focus from the centre
    double radius2_;
    bool isPoint_;
    double inverse_;
};

}  // namespace

glm::dvec2 insideFocus(const Paint& paint) {
    // By a little, so that the gradient has a value everywhere.
    constexpr double maxOff = 0.999;
    const dvec2 center(paint.radial[0], paint.radial[1]), focus(paint.radial[2], paint.radial[3]);
    const double distance = glm::distance(focus, center), maximum = maxOff * double(paint.radial[4]);
    return distance > maximum ? center + (focus - center) * (maximum / distance) : focus;
}

std::unique_ptr<PixelSource> gradientSource(const Paint& paint, const glm::dmat3& fromSurface) {
    if (paint.type == VG_PAINT_TYPE_LINEAR_GRADIENT)
        return std::make_unique<GradientSource<Linear>>(paint, fromSurface);
    return std::make_unique<GradientSource<Radial>>(paint, fromSurface);
}

}  // namespace vtm::openvg
