#include "raster/steepness.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

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
constexpr double minCircleGap = 0.1;

/// The largest singular value.
double stretchOf(const glm::dmat2& m) {
    const double x = glm::dot(m[0], m[0]), y = glm::dot(m[1], m[1]);
    const double half = 0.5 * (x - y), both = glm::dot(m[0], m[1]);
    return std::sqrt(0.5 * (x + y) + std::sqrt(half * half + both * both));
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
struct RampChange {
    double slope = 0;  ///< while u grows by 1, where it is steepest
    double all = 0;    ///< from the first stop to the last, all changes added

    void add(double change, double from, double to) {
        all += change;
        if (change > 0)
            slope = std::max(slope, to > from ? change / (to - from) : infinity);
    }
};

double changeBetween(std::span<const Texel> data, std::uint32_t one, std::uint32_t other) {
    const auto color = [&](std::uint32_t texel) {
        const auto stop = recordAt<GradientStop>(data, texel);
        return vec4(stop.rgba[0], stop.rgba[1], stop.rgba[2], stop.rgba[3]) / 65535.0f;
    };
    return changeBetween(color(one), color(other));
}

constexpr auto headTexels = std::uint32_t(GradientView::headTexels);

/// Calls add(change, first offset, last offset) for every stretch between stops, and where the ramp jumps
/// back; changeFrom(texel): from the stop there to the next one.
template <class ChangeFrom, class Add>
void forEachStretch(std::span<const Texel> data, const Gradient& gradient, std::uint32_t texel,
                    ChangeFrom&& changeFrom, Add&& add) {
    const std::uint32_t first = texel + headTexels, last = first + gradient.stopCount - 1;
    const auto offset = [&](std::uint32_t stop) { return double(std::bit_cast<float>(data[stop][0])); };
    for (std::uint32_t stop = first; stop < last; ++stop)
        add(changeFrom(stop), offset(stop), offset(stop + 1));
    if (gradient.spread == Spread::Repeat)
        add(changeBetween(data, last, first), 1, 1);
}

/// The largest of what the gradient's matrix stretches a vector by.
double stretchOf(const Gradient& gradient) {
    const std::array<float, 6>& m = gradient.matrix;
    return stretchOf(glm::dmat2(m[0], m[1], m[2], m[3]));
}

/// What u changes by, at most, over a unit of the picture.
double offsetSlope(const Gradient& gradient, bool isRadial) {
    const std::array<float, 6>& m = gradient.matrix;
    if (!isRadial)
        return glm::length(dvec2(m[0], m[2]));
    const double gap = 1 - gradient.fr - glm::length(dvec2(gradient.fx, gradient.fy));
    return gap < minCircleGap ? infinity : stretchOf(gradient) / gap;
}

/// What u changes by, at most, in a disc of the gradient's space; 0 where nothing is painted.
///
/// With g = 1 - fr all circles are images of each other about a = f / g: for n, the unit vector from the
/// centre of the circle at u to p, p - a = (u - u(a)) (g n - f). So n, and |∇u| = 1 / |g - n·f|, are the same
/// along a ray from a. With c = |f| cos of the angle between it and f, e = g² - |f|² and s = √(c² + e) that
/// is g / (s (s - c)) if the circles lie within each other, largest on the ray nearest to f. Else e < 0,
/// circles fill the cone c < -√-e, where it is g (s - c) / (s |e|), larger towards the border.
double radialSlopeIn(const Gradient& gradient, dvec2 p, double radius) {
    const dvec2 f(gradient.fx, gradient.fy);
    const double g = 1 - double(gradient.fr), ff = glm::dot(f, f), e = g * g - ff, length = std::sqrt(ff);
    constexpr double touching = 1e-9;
    if (g > 0 && ff == 0)
        return 1 / g;
    if (!(g > 0) || std::abs(e) <= touching * ff)
        return infinity;
    const dvec2 d = p - f / g;
    const double distance = glm::length(d), sine = (1 + touching) * radius / distance;
    if (!(sine < 1))
        return e > 0 ? 1 / (g - length) : infinity;
    const double cosine = std::sqrt(1 - sine * sine), along = glm::dot(d, f) / (distance * length),
                 across = std::sqrt(std::max(1 - along * along, 0.0));
    if (e > 0) {
        const double c = along >= cosine ? length : length * (along * cosine + across * sine),
                     s = std::sqrt(c * c + e);
        return c > 0 ? g * (s + c) / (s * e) : g / (s * (s - c));
    }
    // From the middle of the cone, -f.
    const double border = -std::sqrt(-e), nearest = length * (along * cosine - across * sine),
                 c = length * (along * cosine + across * sine);
    if (along > -cosine && nearest > border)
        return 0;
    if (along >= cosine || c >= border)
        return infinity;
    const double s = std::sqrt(c * c + e);
    return g * (s - c) / (s * -e);
}

/// Of one paint, in doubles.
struct Slopes {
    double slope = 0, variation = 0, roughness = 0;  ///< PaintChange
    bool mayJump = false;

    PaintChange change() const { return {float(slope), float(variation), float(roughness), mayJump}; }
};

/// Modes may make anything of a change, but not of none.
Slopes mixedSlopes(const Slopes& below) {
    return below.slope > 0 ? Slopes{infinity, 0, infinity, true} : Slopes{};
}

Slopes ofGradient(const RampChange& ramp, double offset, float opacity, bool isRadial) {
    if (ramp.slope == 0 || offset == 0)
        return {};
    const double variation = opacity * ramp.all * offset;
    return {opacity * ramp.slope * offset, variation, isRadial ? variation : 0, false};
}

/// Layers over each other change by no more than their changes' sum, and so do those under masks. Filters of
/// images are those of whole pixels, by definition: programs with images are not asked for quarters.
/// gradientOf(instruction): the Slopes of a gradient.
template <class GradientOf>
Slopes ofProgram(std::span<const Texel> data, const Paint& paint, GradientOf&& gradientOf) {
    Slopes all;
    double joint = 0;  // of two layers each, the product
    for (std::uint32_t i = paint[0]; i < paint[0] + paint[1]; ++i) {
        limits::check();
        const auto in = recordAt<Instruction>(data, i);
        if (in.op == Op::Image && in.opacity > 0)
            return {};
        Slopes layer;
        if (in.op == Op::PopMaskLinear || (in.op == Op::Pop && in.blend != Blend::Normal))
            layer = mixedSlopes(all);
        else if (in.op == Op::Material && in.opacity > 0)
            layer.slope = infinity;
        else if ((in.op == Op::Linear || in.op == Op::Radial) && in.opacity > 0)
            layer = gradientOf(in);
        if (all.slope > 0 && layer.slope > 0)
            joint += all.slope * layer.slope;
        all.slope += layer.slope;
        all.variation += layer.variation;
        all.roughness += layer.roughness;
        all.mayJump |= layer.mayJump;
    }
    all.roughness = std::max(all.roughness, 2 * std::sqrt(joint));
    return all;
}

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

/// What u is over the pixels, and what it changes by over a unit of the picture, at most.
struct OffsetsNear {
    double slope;
    Offsets offsets;
};

/// `stretch`: that of a radial gradient.
OffsetsNear offsetsNear(const Gradient& gradient, bool isRadial, double stretch, const PixelsNear& pixels) {
    const std::array<float, 6>& m = gradient.matrix;
    const dvec2 p(m[0] * pixels.middle.x + m[2] * pixels.middle.y + m[4],
                  m[1] * pixels.middle.x + m[3] * pixels.middle.y + m[5]);
    const double radius = pixels.radius + 0.5 * pixels.pixel;
    double slope, u = p.x;
    if (isRadial) {
        slope = stretch * radialSlopeIn(gradient, p, stretch * radius);
        u = std::isfinite(slope) && slope > 0 ? radialOffset(gradient, p) : 0;
    } else {
        slope = offsetSlope(gradient, false);
    }
    const double reach = slope * radius;
    return {slope, {u - reach, u + reach, gradient.spread}};
}

/// What a gradient's ramp changes by over one of the pixels.
double changeNear(const AssetView& asset, std::uint32_t texel, bool isRadial, const PixelsNear& pixels) {
    const auto gradient = recordAt<Gradient>(asset.data, texel);
    if (gradient.stopCount > maxStops)
        return infinity;
    const auto [slope, near] = offsetsNear(gradient, isRadial, stretchOf(gradient), pixels);
    if (slope == 0)
        return 0;
    const double width = slope * pixels.pixel;
    double steepest = 0, sum = 0;
    const auto add = [&](double change, double from, double to) {
        if (!near.meet(from, to))
            return;
        const double maximum = to - from > width ? change / (to - from) * width : change;
        sum += maximum;
        steepest = std::max(steepest, to > from ? change / (to - from) * width : change > 0 ? infinity : 0);
    };
    const auto changeFrom = [&](std::uint32_t stop) { return changeBetween(asset.data, stop, stop + 1); };
    forEachStretch(asset.data, gradient, texel, changeFrom, add);
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

PaintChanges::PaintChanges(const AssetView& asset) : paints_(asset.paints), data_(asset.data) {
    for (const Paint& paint : paints_)
        byPaint_.push_back(isProgram(paint) ? of(paint) : PaintChange{});
}

PaintChange PaintChanges::of(const Paint& paint) {
    const auto gradientOf = [&](const Instruction& in) {
        const GradientChange& gradient = gradientAt(in.argument);
        const bool isRadial = in.op == Op::Radial;
        return ofGradient({gradient.slope, gradient.all},
                          isRadial ? gradient.radialOffset : gradient.linearOffset, in.opacity, isRadial);
    };
    return ofProgram(data_, paint, gradientOf).change();
}

const PaintChanges::GradientChange& PaintChanges::gradientAt(std::uint32_t texel) {
    if (numbers_.empty()) {
        numbers_.resize(data_.size());
        changes_.resize(data_.size());
    }
    if (numbers_[texel] == 0) {
        const auto gradient = recordAt<Gradient>(data_, texel);
        RampChange ramp{infinity, infinity};
        if (gradient.stopCount <= maxStops) {
            const auto changeFrom = [&](std::uint32_t stop) {
                return changes_[stop] = float(changeBetween(data_, stop, stop + 1));
            };
            ramp = {};
            forEachStretch(data_, gradient, texel, changeFrom,
                           [&](double change, double from, double to) { ramp.add(change, from, to); });
            if (ramp.all < minRange)
                ramp = {};
        }
        gradients_.push_back({gradient, stretchOf(gradient), ramp.slope, ramp.all,
                              offsetSlope(gradient, false), offsetSlope(gradient, true)});
        numbers_[texel] = std::uint32_t(gradients_.size());
    }
    return gradients_[numbers_[texel] - 1];
}

PaintChange PaintChanges::near(std::uint32_t paint, const PixelsNear& pixels) const {
    if (byPaint_[paint].steepness == 0)
        return {};
    const auto gradientOf = [&](const Instruction& in) {
        const GradientChange& gradient = gradients_[numbers_[in.argument] - 1];
        const bool isRadial = in.op == Op::Radial;
        if (gradient.slope == 0)
            return Slopes{};
        const OffsetsNear near = offsetsNear(gradient.gradient, isRadial, gradient.stretch, pixels);
        RampChange ramp{gradient.slope, gradient.all};
        if (std::isfinite(ramp.all) && std::isfinite(near.slope)) {
            ramp = {};
            forEachStretch(
                data_, gradient.gradient, in.argument, [&](std::uint32_t stop) { return changes_[stop]; },
                [&](double change, double from, double to) {
                    if (near.offsets.meet(from, to))
                        ramp.add(change, from, to);
                });
        }
        return ofGradient(ramp, near.slope, in.opacity, isRadial);
    };
    return ofProgram(data_, paints_[paint], gradientOf).change();
}

std::vector<PaintChange> changesOf(const AssetView& asset) {
    const PaintChanges changes(asset);
    return {changes.byPaint().begin(), changes.byPaint().end()};
}

float minSteepness(const glm::dmat2& pixel) { return float(minSteepChange / stretchOf(pixel)); }

}  // namespace vtm::asset
