#include "raster/steepness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <vtm/limits/limits.hpp>
#include "asset/records.hpp"

namespace vtm::asset {

namespace {

using glm::dvec2;
using glm::vec4;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Colours that differ by less are one: half a pixel against the whole is off by a quarter of it.
constexpr double minRange = 8.0 / 255;

/// Circles nearer to touching than this have no useful bound: as in gradient.cpp.
constexpr double minGap = 0.1;

/// The largest singular value.
double stretchOf(const glm::dmat2& m) {
    const double x = glm::dot(m[0], m[0]), y = glm::dot(m[1], m[1]);
    return std::sqrt(0.5 * (x + y) + std::hypot(0.5 * (x - y), glm::dot(m[0], m[1])));
}

/// What premultiplied channels change by, at most, while straight colours go from one to another.
double changeBetween(const vec4& a, const vec4& b) {
    const double alpha = std::abs(a.a - b.a), maxAlpha = std::max(a.a, b.a);
    double change = alpha;
    for (int c = 0; c < 3; ++c)
        change = std::max(change, maxAlpha * std::abs(a[c] - b[c]) + alpha * std::max(a[c], b[c]));
    return change;
}

/// More stops are not looked at: gradients of a hostile file may overlap as they like.
constexpr std::uint32_t maxStops = 256;

/// What premultiplied channels change by, at most, along a gradient's ramp.
struct Ramp {
    double slope = 0;  ///< while u grows by 1, where it is steepest
    double all = 0;    ///< from the first stop to the last, all changes added
};

/// Calls add(change, first offset, last offset) for every stretch between stops, and where the ramp jumps
/// back.
template <class Add>
void forEachStretch(const AssetView& asset, const Gradient& gradient, std::uint32_t firstStop, Add&& add) {
    const auto stop = [&](std::uint32_t i) { return recordAt<GradientStop>(asset.data, firstStop + i); };
    const auto color = [&](std::uint32_t i) {
        const GradientStop s = stop(i);
        return vec4(s.rgba[0], s.rgba[1], s.rgba[2], s.rgba[3]) / 65535.0f;
    };
    for (std::uint32_t i = 0; i + 1 < gradient.stopCount; ++i)
        add(changeBetween(color(i), color(i + 1)), double(stop(i).offset), double(stop(i + 1).offset));
    if (gradient.spread == Spread::Repeat)
        add(changeBetween(color(gradient.stopCount - 1), color(0)), 1, 1);
}

Ramp rampOf(const AssetView& asset, const Gradient& gradient, std::uint32_t firstStop) {
    if (gradient.stopCount > maxStops)
        return {infinity, infinity};
    double slope = 0, all = 0;
    forEachStretch(asset, gradient, firstStop, [&](double change, double from, double to) {
        all += change;
        if (change > 0)
            slope = std::max(slope, to > from ? change / (to - from) : infinity);
    });
    return all < minRange ? Ramp{} : Ramp{slope, all};
}

/// What u changes by, at most, over a unit of the picture.
double offsetSlope(const Gradient& gradient, bool isRadial) {
    const std::array<float, 6>& m = gradient.matrix;
    if (!isRadial)
        return glm::length(dvec2(m[0], m[2]));
    const double gap = 1 - gradient.fr - glm::length(dvec2(gradient.fx, gradient.fy));
    return gap < minGap ? infinity : stretchOf({m[0], m[1], m[2], m[3]}) / gap;
}

/// Of one paint, in doubles.
struct Slopes {
    double slope = 0, variation = 0, roughness = 0;  ///< PaintChange
    bool mayJump = false;
};

/// Layers over each other change by no more than their changes' sum, and so do those under masks. Filters of
/// images are those of whole pixels, by definition: programs with images are not asked for quarters.
class SlopesOf {
public:
    explicit SlopesOf(const AssetView& asset) : asset_(asset) {}

    Slopes ofProgram(const Paint& paint) {
        Slopes all;
        int layers = 0;
        for (std::uint32_t i = paint[0]; i < paint[0] + paint[1]; ++i) {
            limits::check();
            const auto in = recordAt<Instruction>(asset_.data, i);
            if (in.op == Op::Image && in.opacity > 0)
                return {};
            const bool isMixed =
                in.op == Op::PopMaskLinear || (in.op == Op::Pop && in.blend != Blend::Normal);
            const Slopes layer = isMixed ? mixed(all) : ofLayer(in);
            layers += layer.slope > 0;
            all.slope += layer.slope;
            all.variation += layer.variation;
            all.roughness += layer.roughness;
            all.mayJump |= layer.mayJump;
        }
        if (layers > 1)
            all.roughness = all.slope;
        return all;
    }

private:
    /// Modes may make anything of a change, but not of none.
    static Slopes mixed(const Slopes& below) {
        return below.slope > 0 ? Slopes{infinity, 0, infinity, true} : Slopes{};
    }
    Slopes ofLayer(const Instruction& in) {
        if (in.opacity <= 0)
            return {};
        switch (in.op) {
            case Op::Linear:
            case Op::Radial: {
                const auto gradient = recordAt<Gradient>(asset_.data, in.argument);
                const Ramp ramp = ofRamp(gradient, in.argument);
                const double offset = offsetSlope(gradient, in.op == Op::Radial);
                if (ramp.slope == 0 || offset == 0)
                    return {};
                const double variation = in.opacity * ramp.all * offset;
                return {in.opacity * ramp.slope * offset, variation, in.op == Op::Radial ? variation : 0,
                        false};
            }
            case Op::Material:
                return {infinity, 0, 0, false};
            default:
                return {};
        }
    }
    Ramp ofRamp(const Gradient& gradient, std::uint32_t texel) {
        if (ramps_.empty())
            ramps_.resize(asset_.data.size());
        std::optional<Ramp>& ramp = ramps_[texel];
        if (!ramp)
            ramp = rampOf(asset_, gradient, texel + std::uint32_t(GradientView::headTexels));
        return *ramp;
    }

    const AssetView& asset_;
    std::vector<std::optional<Ramp>> ramps_;  ///< by texel: many programs may use one
};

// ---- Near a place ---------------------------------------------------------------------------------

/// Offsets, of which a periodic ramp's begin in its first period.
struct Offsets {
    double from, to, period;  ///< 0: padded

    Offsets(double low, double high, Spread spread)
        : from(low),
          to(high),
          period(spread == Spread::Pad      ? 0
                 : spread == Spread::Repeat ? 1
                                            : 2) {
        if (period > 0) {
            from -= period * std::floor(low / period);
            to = from + (high - low);
        }
    }
    /// Those of a stretch, in the first period or the next; reflected ramps have it backwards, too.
    bool meet(double first, double last) const {
        return meetOne(first, last) || (period == 2 && meetOne(2 - last, 2 - first));
    }

private:
    bool meetOne(double first, double last) const {
        const bool isWhole = period > 0 && !(to - from < period);
        return isWhole || (first <= to && last >= from) ||
               (period > 0 && first + period <= to && last + period >= from);
    }
};

/// The larger root of gradient.cpp's radialOffset(), for circles that lie within each other.
double radialOffset(const Gradient& gradient, dvec2 p) {
    const dvec2 f(gradient.fx, gradient.fy), d = p - f;
    const double fr = gradient.fr, grow = 1 - fr, a = grow * grow - glm::dot(f, f);
    const double b = (glm::dot(d, f) - fr * grow) / a;
    return b + std::sqrt(std::max(b * b + (glm::dot(d, d) - fr * fr) / a, 0.0));
}

/// What a gradient's ramp changes by over one of the pixels.
double changeNear(const AssetView& asset, std::uint32_t texel, bool isRadial, const PixelsNear& pixels) {
    const auto gradient = recordAt<Gradient>(asset.data, texel);
    if (gradient.stopCount > maxStops)
        return infinity;
    const std::array<float, 6>& m = gradient.matrix;
    const dvec2 p(m[0] * pixels.middle.x + m[2] * pixels.middle.y + m[4],
                  m[1] * pixels.middle.x + m[3] * pixels.middle.y + m[5]);
    const double slope = offsetSlope(gradient, isRadial), width = slope * pixels.pixel;
    const double u = isRadial && std::isfinite(slope) ? radialOffset(gradient, p) : p.x;
    const double reach = slope * pixels.radius + 0.5 * width;
    const Offsets offsets(u - reach, u + reach, gradient.spread);
    double steepest = 0, sum = 0;
    const auto add = [&](double change, double from, double to) {
        if (!offsets.meet(from, to))
            return;
        const double maximum = to - from > width ? change / (to - from) * width : change;
        sum += maximum;
        steepest = std::max(steepest, to > from ? change / (to - from) * width : change > 0 ? infinity : 0);
    };
    forEachStretch(asset, gradient, texel + std::uint32_t(GradientView::headTexels), add);
    return std::min(sum, steepest);
}

}  // namespace

NearChange changeNear(const AssetView& asset, std::uint32_t paint, const PixelsNear& pixels) {
    if (!isProgram(asset.paints[paint]))
        return {};
    const Paint& program = asset.paints[paint];
    double sum = 0, joint = 0;
    for (std::uint32_t i = program[0]; i < program[0] + program[1]; ++i) {
        limits::check();
        const auto in = recordAt<Instruction>(asset.data, i);
        double change = 0;
        if (in.op == Op::Image && in.opacity > 0)
            return {};
        if (in.op == Op::Material)
            change = infinity;
        else if (in.op == Op::Linear || in.op == Op::Radial)
            change = in.opacity * changeNear(asset, in.argument, in.op == Op::Radial, pixels);
        else if (in.op == Op::PopMaskLinear || (in.op == Op::Pop && in.blend != Blend::Normal))
            change = sum;  // modes double what changes below them, mostly
        if (change > 0 && sum > 0)
            joint += 0.25 * change * sum;
        sum += change;
    }
    return {float(sum), float(joint)};
}

std::vector<PaintChange> changesOf(const AssetView& asset) {
    SlopesOf changes(asset);
    std::vector<PaintChange> byPaint;
    for (const Paint& paint : asset.paints) {
        const Slopes change = isProgram(paint) ? changes.ofProgram(paint) : Slopes{};
        byPaint.push_back(
            {float(change.slope), float(change.variation), float(change.roughness), change.mayJump});
    }
    return byPaint;
}

std::vector<float> steepnessOf(const AssetView& asset) {
    std::vector<float> steepness;
    for (const PaintChange& change : changesOf(asset))
        steepness.push_back(change.steepness);
    return steepness;
}

float minSteepness(const glm::dmat2& pixel) { return float(minSteepChange / stretchOf(pixel)); }

}  // namespace vtm::asset
