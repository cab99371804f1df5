#include "raster/src/row_paint.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <glm/vec4.hpp>

#include "raster/src/ramp.hpp"
#include "raster/src/rough.hpp"

namespace vtm::asset {

namespace {

using glm::dvec2;
using glm::vec2;

constexpr float unbounded = std::numeric_limits<float>::infinity();

/// The colour in a pixel's middle is taken for the mean over it if that is no further away: an eighth of a
/// step of 8 bits.
constexpr float rowTolerance = 1.0f / 2048;

/// The two samples that a polynomial does not pass through are no further from it.
constexpr float sampleTolerance = rowTolerance / 4;

/// What the mean beyond a stop is off by, in pixels, if u is taken for even over a pixel: directions differ
/// in it.
constexpr float shapeError = 0.0045f;

/// A pixel whose sides change u by a vector of length 1 is as if u were even over so much to both sides: 4 /
/// 8 along them, 4 / 6 √2 across.
constexpr float evenWidth = 0.486f;

/// Means of layers over a part of a pixel are laid over each other where two that change by c and d differ by
/// c d of no more: their mean is off by a twelfth of that, as in whole pixels.
constexpr float maxJointChange = 12 * maxMeanDifference;

/// More stops are left to others: making segments of them costs more than a few rows gain.
constexpr std::size_t maxRowStops = 128;
/// The same of gradients over each other.
constexpr std::size_t maxRowLayers = 16;
/// And periods of fewer pixels: most of their pixels meet stops, and rows fall into short runs.
constexpr float leastPeriod = 16;
static_assert(longestRow <= 64);  // bits

}  // namespace

RowGradient::Offsets RowGradient::Segment::held(Offsets offsets) const {
    int count = 0;  // mostly all of them, which is counted without a branch
    for (const float u : offsets)
        count += int(u >= low) & int(u < high);
    if (std::size_t(count) == offsets.size())
        return offsets;
    std::size_t held = 1;
    while (held < offsets.size() && holds(offsets[held]))
        ++held;
    return offsets.first(held);
}

void RowGradient::Segment::fill(Offsets offsets, std::span<Float4> colors) const {
    if (shape == Shape::Curved)
        for (std::size_t i = 0; i < colors.size(); ++i)
            colors[i] = color + (offsets[i] - start) * (slope + (offsets[i] - start) * bend);
    else
        for (std::size_t i = 0; i < colors.size(); ++i)
            colors[i] = color + (offsets[i] - start) * slope;
}

PixelRange RowGradient::radialOffsets(Pixel first, std::span<float> offsets) const {
    const vec2 d = radial_.fromFocus(first), change(radial_.right);
    radial_.circles.rowOffsets(d, change, offsets);
    return nearOrigin(d, change, radial_.near * radial_.near, offsets.size());
}

float RowGradient::radialWidth(Pixel pixel, float u) const {
    const vec2 d = radial_.fromFocus(pixel);
    const NestedCircles& circles = radial_.circles;
    const vec2 slope = (u * circles.f + d) * (circles.inverse / std::max(u - circles.b(d.x, d.y), 1e-6f));
    return evenWidth * std::hypot(glm::dot(slope, vec2(radial_.right)), glm::dot(slope, vec2(radial_.down)));
}

namespace {

/// What a number of pixels differs by from the first one.
Float4 stepsFrom(const RowGradient::Pixels& pixels, int RowGradient::Pixel::*number) {
    const auto step = [&](std::size_t i) { return float(pixels[i].*number - pixels[0].*number); };
    return Float4{0, step(1), step(2), step(3)};
}

}  // namespace

Float4 RowGradient::offsetsAt(Pixel first, Float4 right, Float4 down, unsigned& known) const {
    if (!isRadial_)
        return linear_.at(first) + right * float(linear_.right) + down * float(linear_.down);
    const vec2 d = radial_.fromFocus(first), toRight(radial_.right), toDown(radial_.down);
    const Float4 x = d.x + right * toRight.x + down * toDown.x, y = d.y + right * toRight.y + down * toDown.y;
    const Float4 squared = x * x + y * y, b = radial_.circles.b(x, y);
    for (unsigned i = 0; i < 4; ++i)
        known &= ~(unsigned(squared[i] <= radial_.near * radial_.near) << i);
    return b + radial_.circles.root(b, squared);
}

unsigned RowGradient::layOver(const Pixels& pixels, Colors& colors) {
    unsigned known = 15;
    const Float4 offsets =
        offsetsAt(pixels[0], stepsFrom(pixels, &Pixel::x), stepsFrom(pixels, &Pixel::row), known);
    for (unsigned i = 0; i < 4; ++i) {
        const float u = offsets[i];
        const Segment& segment = find(u);
        if (segment.shape == Shape::Mixed)
            known &= ~(1u << i);
        else
            colors[i] = over(
                segment.shape == Shape::Turning ? segment.turned(u, widthAt(pixels[i], u)) : segment.at(u),
                colors[i]);
    }
    return known;
}

unsigned RowGradient::layOver(const Parts& parts, Colors& colors, Changes& changes) {
    unsigned known = 15, ignored = 15;
    const Float4 right = stepsFrom(parts.pixels, &Pixel::x), down = stepsFrom(parts.pixels, &Pixel::row);
    const Float4 middles = offsetsAt(parts.pixels[0], right, down, known),
                 offsets = offsetsAt(parts.pixels[0], right + parts.right, down + parts.down, ignored);
    for (unsigned i = 0; i < 4; ++i) {
        const Segment& segment = find(middles[i]);
        if (segment.shape == Shape::Mixed) {
            known &= ~(1u << i);
        } else {
            colors[i] = over(segment.shape == Shape::Turning
                                 ? segment.turned(offsets[i], widthAt(parts.pixels[i], middles[i]))
                                 : segment.at(offsets[i]),
                             colors[i]);
            changes.joint[i] += segment.perPixel * changes.sum[i];
            changes.sum[i] += segment.perPixel;
        }
    }
    return known;
}

int RowGradient::layOver(Pixel first, int count, Samples* colors) {
    const float step = float(count - 1) / (samples - 1), length = float(count - 1);
    const Float4 steps = step * Float4{0, 1, 2, 3};
    Float4 some;  // offsets, of all but the last sample
    float last;
    if (isRadial_) {
        const vec2 d = radial_.fromFocus(first), right(radial_.right);
        const float clear = 2 * step * radial_.pixel + radial_.near;
        if (const PixelRange near = nearOrigin(d, right, clear * clear, std::size_t(count));
            near.first < near.end)
            return count / 2;
        const CircleSteps row = radial_.circles.stepsFrom(d, right);
        some = row.at(steps);
        last = row.at(length);
    } else {
        const float change = float(linear_.right);
        some = linear_.at(first) + change * steps;
        last = some[0] + length * change;
    }
    const Segment& segment = find(some[0]);
    if (segment.shape == Shape::Turning || segment.shape == Shape::Mixed)
        return 0;
    const std::array<float, samples> offsets{some[0], some[1], some[2], some[3], last};
    if (!segment.hold(some) || !segment.holds(last))
        return std::min(int(step * stepsIn(segment, offsets)) + 1, count - 1);
    if (isRadial_ && dipOf(offsets) > std::min({some[0], some[1], some[2], some[3], last}) - segment.low)
        return count / 2;
    if (colors && !segment.isClear)
        for (std::size_t i = 0; i < samples; ++i)
            (*colors)[i] = over(segment.at(offsets[i]), (*colors)[i]);
    return count;
}

/// How many steps between samples it takes to leave the segment; the first one is in it.
float RowGradient::stepsIn(const Segment& segment, std::span<const float> offsets) {
    std::size_t i = 1;
    while (i + 1 < offsets.size() && segment.holds(offsets[i]))
        ++i;
    const float before = offsets[i - 1], bound = offsets[i] < segment.low ? segment.low : segment.high;
    const float share = (bound - before) / (offsets[i] - before);
    return float(int(i) - 1) + (share > 0 ? std::min(share, 1.0f) : 0);  // of NaN nothing
}

/// u is convex along a row: between two samples it is no more than that below both.
float RowGradient::dipOf(const std::array<float, samples>& u) {
    return 0.125f * std::max({u[2] - 2 * u[1] + u[0], u[3] - 2 * u[2] + u[1], u[4] - 2 * u[3] + u[2]});
}

// ---- Segments -------------------------------------------------------------------------------------

bool RowGradient::prepare(const GradientView& gradient, bool isRadial, const Solids& solids,
                          const PixelMiddles& pixels) {
    isRadial_ = isRadial;
    segments_.clear();
    last_ = 0;
    const Gradient& g = gradient.gradient();
    const Blur blur = blur_ = isRadial ? prepareRadial(g, pixels) : prepareLinear(g, pixels);
    if (!std::isfinite(blur.reach) || (g.spread != Spread::Pad && 2 * blur.reach * leastPeriod > 1))
        return false;
    const std::vector<Stop> stops = stopsIn(gradient, offsetsIn(pixels));
    if (stops.empty())
        return false;
    makeSegments(stops, g.spread, blur, solids);
    return std::ranges::any_of(segments_, [](const Segment& s) { return s.shape != Shape::Mixed; });
}

RowGradient::Blur RowGradient::prepareLinear(const Gradient& gradient, const PixelMiddles& pixels) {
    const std::array<float, 6>& m = gradient.matrix;
    const dvec2 slope(m[0], m[2]);
    linear_ = {glm::dot(slope, pixels.first) + m[4], glm::dot(slope, pixels.right),
               glm::dot(slope, pixels.down), 0};
    const float one = float(std::abs(linear_.right)), other = float(std::abs(linear_.down));
    const float longer = std::max(one, other), shorter = std::min(one, other);
    // u is spread over a trapezoid, whose half is (r³ - f³) / 6 on one side (ramp.cpp).
    const float reach = 0.5f * (longer + shorter), flat = 0.5f * (longer - shorter);
    const float half = shorter > 1e-3f * longer
                           ? (reach * reach * reach - flat * flat * flat) / (6 * longer * shorter)
                           : 0.125f * longer;
    const float length = std::hypot(longer, shorter);
    linear_.width = 4 * half;
    return {reach, length, linear_.width, length * length / 12, 0};
}

RowGradient::Blur RowGradient::prepareRadial(const Gradient& gradient, const PixelMiddles& pixels) {
    const std::array<float, 6>& m = gradient.matrix;
    const vec2 f(gradient.fx, gradient.fy);
    const float offCentre = glm::length(f), grow = 1 - gradient.fr, gap = grow - offCentre;
    if (!(gap >= minGap))
        return {unbounded, 0, 0, 0, 0};
    const glm::dmat2 linear(m[0], m[1], m[2], m[3]);
    const dvec2 first = linear * pixels.first + dvec2(m[4], m[5]) - dvec2(f);
    radial_ = {first, linear * pixels.right, linear * pixels.down, {f, gradient.fr}, 0, 0};
    const vec2 right(radial_.right), down(radial_.down);
    const float squares = glm::dot(right, right) + glm::dot(down, down);
    const float area = std::abs(right.x * down.y - right.y * down.x);
    // What the sides change u by has a length between these: singular values, times the slope of u.
    const float longest =
        std::sqrt(0.5f * (squares + std::sqrt(std::max(squares * squares - 4 * area * area, 0.0f))));
    const float most = longest / gap, least = longest > 0 ? area / longest / (grow + offCentre) : 0;
    radial_.near = std::sqrt(farFromTip * squares);
    radial_.pixel = longest;
    return {0.5f * (glm::length(right) + glm::length(down)) / gap, most, evenWidth * most,
            (least * least + most * most) / 24, (most * most - least * least) / 24};
}

void RowGradient::add(Segment segment, const Solids& solids) {
    if (!(segment.low < segment.high))
        return;
    const float low = segments_.empty() ? -unbounded : segments_.back().high;
    if (low < segment.low)
        segments_.push_back(mixed(low, segment.low));
    segment.color = solids.color(segment.color);
    segment.slope = solids.change(segment.slope);
    segment.bend = solids.change(segment.bend);
    segment.turn = solids.change(segment.turn);
    segment.turnBend = solids.change(segment.turnBend);
    segment.isClear = segment.shape == Shape::Constant && !(largest(segment.color) > 0);
    segment.perPixel = blur_.length * (largest(segment.slope) + largest(segment.turn));
    if (largest(segment.bend) > 0)
        segment.perPixel += blur_.length * 2 * (segment.high - segment.low) * largest(segment.bend);
    if (blur_.variance * largest(segment.bend) > rowTolerance)  // parts have less of it than pixels
        segment.perPixel = unbounded;
    segments_.push_back(segment);
}

RowGradient::Segment RowGradient::mixed(float low, float high) {
    return {low, high, 0, 0, Shape::Mixed, Float4{}, Float4{}, Float4{}, Float4{}, Float4{}};
}

RowGradient::Range RowGradient::offsetsIn(const PixelMiddles& pixels) const {
    const auto at = [&](Pixel pixel) { return isRadial_ ? radial_.at(pixel) : linear_.at(pixel); };
    const int right = pixels.width - 1, bottom = pixels.height - 1;
    // u is convex: in a cone it is least at the tip.
    const auto [low, high] = std::minmax({at({0, 0}), at({right, 0}), at({0, bottom}), at({right, bottom})});
    const float tip = -radial_.circles.fr / (1 - radial_.circles.fr);
    return {isRadial_ ? std::min(low, tip) : low, high};
}

/// Those of all periods in the range, each with what lies at its ends; none if they are too many.
std::vector<RowGradient::Stop> RowGradient::stopsIn(const GradientView& gradient, const Range& range) {
    const std::size_t count = gradient.size();
    const Spread spread = gradient.gradient().spread;
    const float first = spread == Spread::Pad ? 0 : std::floor(range.low),
                last = spread == Spread::Pad ? 0 : std::floor(range.high);
    if (!((last - first + 1) * float(count + 2) <= float(maxRowStops)))
        return {};
    std::vector<Stop> stops;
    for (float period = first; period <= last; ++period) {
        const bool isBackwards = spread == Spread::Reflect && std::fmod(period, 2.0f) != 0;
        const auto add = [&](float offset, std::size_t of) {
            stops.push_back({period + (isBackwards ? 1 - offset : offset), float4(gradient.color(of))});
        };
        const auto addEnd = [&](bool isLast) {
            if (spread != Spread::Pad)
                add(float(isLast), isLast ? count - 1 : 0);
        };
        addEnd(isBackwards);
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t of = isBackwards ? count - 1 - i : i;
            add(gradient.offset(of), of);
        }
        addEnd(!isBackwards);
    }
    return stops;
}

void RowGradient::makeSegments(std::span<const Stop> stops, Spread spread, const Blur& blur,
                               const Solids& solids) {
    // The stretches between stops.
    std::array<Segment, maxRowStops + 1> stretches;
    std::size_t count = 0;
    float steepest = 0;
    const auto addStretch = [&](float low, float high, Float4 straight, Float4 straightSlope) {
        const Float4 slope = changeOf(straight, straightSlope), bend = bendOf(straightSlope);
        const bool isBent = largest(bend) > 0, isSloping = largest(slope) > 0;
        const Shape shape = largest(bend) * blur.varianceError > rowTolerance ? Shape::Mixed
                            : isBent                                          ? Shape::Curved
                            : isSloping                                       ? Shape::Straight
                                                                              : Shape::Constant;
        if (isSloping || isBent)
            steepest = std::max(steepest, largest(slope) + 2 * (high - low) * largest(bend));
        const float start = std::isfinite(low) ? low : 0;
        stretches[count++] = {low,   high, start,    0,       shape, premultiplied(straight),
                              slope, bend, Float4{}, Float4{}};
    };
    const bool isPadded = spread == Spread::Pad;
    if (isPadded)
        addStretch(-unbounded, stops.front().offset, stops.front().color, Float4{});
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
        const Stop &low = stops[i], &high = stops[i + 1];
        if (low.offset < high.offset)
            addStretch(low.offset, high.offset, low.color,
                       (high.color - low.color) / (high.offset - low.offset));
    }
    if (isPadded)
        addStretch(stops.back().offset, unbounded, stops.back().color, Float4{});
    if (isRadial_)
        limitTip(steepest * blur.length);

    float below = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const Joint above =
            i + 1 < count ? jointOf(stretches[i], stretches[i + 1], blur) : Joint{0, mixed(0, 0)};
        Segment segment = stretches[i];
        segment.low += below;
        segment.high -= above.margin;
        segment.color += blur.variance * segment.bend;
        if (segment.shape != Shape::Mixed)
            add(segment, solids);
        if (above.segment.shape != Shape::Mixed)
            add(above.segment, solids);
        below = above.margin;
    }
    const float end = segments_.empty() ? -unbounded : segments_.back().high;
    if (end < unbounded)
        segments_.push_back(mixed(end, unbounded));
}

RowGradient::Joint RowGradient::jointOf(const Segment& one, const Segment& next, const Blur& blur) {
    const float stop = next.low, x = stop - one.start;
    const Float4 jump = next.color - one.at(stop), turn = next.slope - (one.slope + 2 * x * one.bend),
                 bend = next.bend - one.bend;
    // A pixel sees a single stop.
    const bool areLong = std::min(one.high - one.low, next.high - next.low) >= 2 * blur.reach;
    const float off = shapeError * blur.length * largest(turn) +
                      (0.07f * blur.width * blur.width + blur.varianceError) * largest(bend);
    if (!areLong || one.shape == Shape::Mixed || next.shape == Shape::Mixed ||
        std::max(0.5f * largest(jump), off) > rowTolerance)
        return {blur.reach, mixed(0, 0)};
    if (0.25f * blur.width * largest(turn) + blur.variance * largest(bend) <= rowTolerance)
        return {0, mixed(0, 0)};
    Segment segment = one;
    segment.low = stop - blur.width;
    segment.high = stop + blur.width;
    segment.stop = stop;
    segment.shape = Shape::Turning;
    segment.color += blur.variance * one.bend;
    segment.turn = turn;
    segment.turnBend = bend;
    return {blur.width, segment};
}

void RowGradient::limitTip(float change) {
    // At a distance of d pixels the mean of u over a pixel is 1 / (24 d) of a pixel more, at the tip 0.38.
    const float distance = 0.38f * change <= rowTolerance ? 0 : std::max(change / (20 * rowTolerance), 0.75f);
    radial_.near = std::min(radial_.near, distance * radial_.pixel);
}

// ---- Programs -------------------------------------------------------------------------------------

void RowPaint::prepare(const Paints& paints, std::uint32_t paint, const PixelMiddles& pixels) {
    size_ = 0;
    isLinear_ = true;
    const std::span<const Texel> data = paints.asset().data;
    const Paint& program = paints.asset().paints[paint];
    RowGradient::Solids solids;
    Instruction gradient{};  // the last one
    const auto add = [&] {
        solids.opacity = gradient.opacity;
        return addLayer({data, paints.stopColors(), gradient.argument}, gradient.op == Op::Radial, solids,
                        pixels);
    };
    for (std::uint32_t i = program[0]; i < program[0] + program[1]; ++i) {
        const auto in = recordAt<Instruction>(data, i);
        const bool isFirst = gradient.op == Op::Push;
        if (in.op == Op::Solid) {
            Float4& solid = isFirst ? solids.below : solids.above;
            solid = over(in.opacity * float4(std::bit_cast<glm::vec4>(data[in.argument])), solid);
        } else if (in.op == Op::Linear || in.op == Op::Radial) {
            if (!isFirst && (size_ == maxRowLayers || !add())) {
                size_ = 0;
                return;
            }
            if (!isFirst)
                solids = {};
            gradient = in;
            isLinear_ &= in.op == Op::Linear;
        } else {
            size_ = 0;
            return;
        }
    }
    if (gradient.op == Op::Push || !add())
        size_ = 0;
}

unsigned RowPaint::at(const RowGradient::Parts& parts, RowGradient::Colors& colors) {
    unsigned known = isReady() ? 15 : 0;
    colors = {};
    RowGradient::Changes changes;
    for (std::size_t k = 0; k < size_ && known != 0; ++k)
        known &= layers_[k].layOver(parts, colors, changes);
    for (unsigned i = 0; i < 4; ++i)
        known &= ~(unsigned(!(changes.joint[i] <= maxJointChange && changes.sum[i] < unbounded)) << i);
    return known;
}

bool RowPaint::addLayer(const GradientView& gradient, bool isRadial, const RowGradient::Solids& solids,
                        const PixelMiddles& pixels) {
    if (layers_.size() == size_)
        layers_.emplace_back();
    return layers_[size_++].prepare(gradient, isRadial, solids, pixels);
}

int RowPaint::sample(Pixel first, int maximum, RowColors& colors) {
    for (int count = maximum; count >= fewSampled;) {
        const int right = sampleOnce(first, count, colors);
        if (right == count)
            return count;
        count = right;
    }
    return 0;
}

int RowPaint::sampleOnce(Pixel first, int count, RowColors& colors) {
    RowGradient::Samples at{};
    int right = count;
    for (std::size_t k = 0; k < size_ && right >= fewSampled; ++k)
        right = right == count ? layers_[k].layOver(first, count, &at)
                               : layers_[k].layOver(first, right, nullptr);
    if (right < count)
        return right;
    // Through every second one; the others are near it if there is no more than that.
    const Float4 once = at[2] - at[0], twice = at[0] - 2 * at[2] + at[4];
    const Float4 one = at[1] - (at[0] + 0.5f * once - 0.125f * twice),
                 three = at[3] - (at[0] + 1.5f * once + 0.375f * twice);
    if (!(std::max(largest(one), largest(three)) <= sampleTolerance))
        return count / 2;
    const float perPixel = 2 / float(count - 1);
    colors = {at[0], perPixel * (once - 0.5f * twice), 0.5f * perPixel * perPixel * twice, 2};
    return count;
}

std::uint64_t RowPaint::compose(Pixel pixel, std::span<Float4> colors) {
    std::uint64_t left = 0;
    const auto leave = [&](std::size_t first, std::size_t end) {
        left |= (~std::uint64_t(0) >> (64 - (end - first))) << first;
    };
    layers_[0].visit(
        pixel, colors.size(),
        [&](std::size_t first, std::size_t end, Float4 color) {
            std::ranges::fill(colors.subspan(first, end - first), color);
        },
        [&](std::size_t first, std::span<const Float4> some) {
            std::ranges::copy(some, colors.begin() + std::ptrdiff_t(first));
        },
        leave);
    for (std::size_t k = 1; k < size_; ++k)
        layers_[k].visit(
            pixel, colors.size(),
            [&](std::size_t first, std::size_t end, Float4 color) {
                if (largest(color) > 0)
                    for (Float4& below : colors.subspan(first, end - first))
                        below = over(color, below);
            },
            [&](std::size_t first, std::span<const Float4> some) {
                for (const Float4& color : some) {
                    colors[first] = over(color, colors[first]);
                    ++first;
                }
            },
            leave);
    return left;
}

}  // namespace vtm::asset
