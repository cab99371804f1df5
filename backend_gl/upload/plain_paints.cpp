#include "backend_gl/upload/plain_paints.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <vtm/limits/limits.hpp>
#include "asset/records.hpp"

namespace vtm::gl {

namespace {

using asset::Gradient;
using asset::GradientStop;
using asset::Instruction;
using asset::Op;
using asset::Spread;
using asset::Texel;
using glm::dvec2;
using glm::dvec4;

constexpr std::uint32_t texelMask = (1u << plainTexelBits) - 1;

/// Of all paints: 4 MiB. Programs beyond are not plain.
constexpr std::size_t maxPlainTexels = std::size_t(1) << 18;
/// Of a gradient. One with more has no bound on its steepness.
constexpr std::uint32_t maxPlainStops = 256;

PaintWords wordsOf(const dvec4& color) {
    const auto channel = [](double value) {
        return std::uint32_t(std::lround(glm::clamp(value, 0.0, 1.0) * 65535));
    };
    return {channel(color.r) | channel(color.g) << 16, channel(color.b) | channel(color.a) << 16};
}

/// Premultiplied.
dvec4 over(const dvec4& source, const dvec4& backdrop) { return source + (1 - source.a) * backdrop; }

/// Segments, or parts of t: where a hard stop's two colours are told apart.
constexpr double besideStop = 1e-6;

/// A gradient between two colours, premultiplied, along t in [0, 1]; u = -start + (1 + start) t.
class TableSource {
public:
    TableSource(std::span<const Texel> data, std::uint32_t texel, const Gradient& gradient, double start,
                double opacity, const dvec4& above, const dvec4& below)
        : start_(start), opacity_(opacity), above_(above), below_(below) {
        for (std::uint32_t i = 0; i < gradient.stopCount; ++i) {
            const auto stop = asset::recordAt<GradientStop>(
                data, texel + std::uint32_t(asset::GradientView::headTexels) + i);
            offsets_.push_back(double(stop.offset));
            colors_.push_back(dvec4(stop.rgba[0], stop.rgba[1], stop.rgba[2], stop.rgba[3]) / 65535.0);
        }
    }

    dvec4 at(double t) const {
        const double u = (1 + start_) * t - start_;
        const auto next = std::size_t(std::ranges::upper_bound(offsets_, u) - offsets_.begin());
        if (next == 0 || next == offsets_.size())
            return between(next == 0 ? colors_.front() : colors_.back());
        const double from = offsets_[next - 1], share = (u - from) / (offsets_[next] - from);
        return between(glm::mix(colors_[next - 1], colors_[next], share));
    }

    /// The table, unless none of all sizes is near enough.
    std::optional<std::vector<Texel>> table() const {
        if (!isNear(0, -besideStop, at(0), at(0)))
            return std::nullopt;
        for (unsigned log2 = 0; log2 <= maxSegmentsLog2; ++log2)
            if (std::optional<std::vector<Texel>> found = ofSize(1u << log2))
                return found;
        return std::nullopt;
    }

private:
    dvec4 between(const dvec4& straight) const {
        const double alpha = opacity_ * straight.a;
        return over(above_,
                    over({alpha * straight.r, alpha * straight.g, alpha * straight.b, alpha}, below_));
    }

    /// Within a segment the ramp is furthest from its chord at a stop, or about in the middle, as it is a
    /// quadratic between stops. Stops first, as most sizes that fail do so there.
    std::optional<std::vector<Texel>> ofSize(std::size_t segments) const {
        for (const double offset : offsets_) {
            const double place = (offset + start_) / (1 + start_) * double(segments);
            // On both sides of a stop, as it may be a hard one.
            for (const double t : {place - besideStop, place + besideStop})
                if (const double i = std::floor(t);
                    i >= 0 && i < double(segments) &&
                    !isNear(t - i, t / double(segments), at(i / double(segments)),
                            at((i + 1) / double(segments))))
                    return std::nullopt;
        }
        std::vector<Texel> texels;
        for (std::size_t i = 0; i < segments; ++i) {
            const dvec4 from = at(double(i) / double(segments)), to = at(double(i + 1) / double(segments));
            if (!isNear(0.5, (double(i) + 0.5) / double(segments), from, to))
                return std::nullopt;
            const PaintWords a = wordsOf(from), b = wordsOf(to);
            texels.push_back({a[0], a[1], b[0], b[1]});
        }
        return texels;
    }
    bool isNear(double share, double t, const dvec4& from, const dvec4& to) const {
        const dvec4 gap = glm::abs(glm::mix(from, to, share) - at(t));
        return std::max({gap.r, gap.g, gap.b, gap.a}) <= maxTableError;
    }

    double start_, opacity_;
    dvec4 above_, below_;
    std::vector<double> offsets_;
    std::vector<dvec4> colors_;
};

/// A layer's numbers; without the table.
struct LayerForm {
    std::array<float, 3> first{};
    std::array<float, 4> second{};  ///< of a radial one
    std::uint32_t bits = 0;
    double start = 0;  ///< of u at t = 0, negated

    bool isFinite() const {
        const auto finite = [](float v) { return std::isfinite(v); };
        return std::ranges::all_of(first, finite) && std::ranges::all_of(second, finite);
    }
};

/// Where the circles of a radial gradient lie within each other by this much; as in steepness.cpp.
constexpr double minCircleGap = 0.1;

/// With d = p - f, f along the x axis, the offset is u = b + sqrt(b² + c), b = (dx |f| - fr (1-fr)) / a,
/// c = (|d|² - fr²) / a, a = (1-fr)² - |f|² (gradient.cpp). Under the root stands a sum of two squares:
///     q = (((1-fr) dx - |f| fr) / a, dy / sqrt(a)),   u = |q| + e q.x - k,
/// e = |f| / (1-fr), k = fr / (1-fr). t = (u + k) / (1 + k) is 0 where the cone has its tip and 1 where u is.
std::optional<LayerForm> radialForm(const Gradient& g) {
    const double focus = std::hypot(double(g.fx), double(g.fy)), rest = 1 - double(g.fr);
    if (rest - focus < minCircleGap)
        return std::nullopt;
    const double a = rest * rest - focus * focus, k = double(g.fr) / rest, scale = 1 / (1 + k);
    const dvec2 axis = focus > 0 ? dvec2(g.fx, g.fy) / focus : dvec2(1, 0), across(-axis.y, axis.x);
    const auto row = [&](const dvec2& direction, double factor, double more) {
        const auto& m = g.matrix;
        const dvec2 origin = dvec2(m[4], m[5]) - dvec2(g.fx, g.fy);
        return std::array<float, 3>{float(factor * glm::dot(direction, dvec2(m[0], m[1]))),
                                    float(factor * glm::dot(direction, dvec2(m[2], m[3]))),
                                    float(factor * glm::dot(direction, origin) + more)};
    };
    LayerForm form;
    form.first = row(axis, scale * rest / a, -scale * focus * double(g.fr) / a);
    const std::array<float, 3> other = row(across, scale / std::sqrt(a), 0);
    form.second = {other[0], other[1], other[2], float(focus / rest)};
    form.bits = radialBit;
    form.start = k;
    return form;
}

LayerForm linearForm(const Gradient& g) { return {{g.matrix[0], g.matrix[2], g.matrix[4]}, {}, 0, 0}; }

/// A gradient of a program, and the colours that lie next to it.
struct GradientLayer {
    Instruction gradient;
    dvec4 above{0}, below{0};
};

/// Makes programs, each table once.
class PlainPrograms {
public:
    PlainPrograms(const asset::AssetView& asset, std::vector<Texel>& texels)
        : asset_(asset), texels_(texels) {}

    std::optional<PaintWords> make(const asset::Paint& program) {
        std::vector<GradientLayer> layers;
        dvec4 color(0);  // above no gradient
        for (std::uint32_t i = 0; i < program[1]; ++i) {
            limits::check();
            const auto in = asset::recordAt<Instruction>(asset_.data, program[0] + i);
            if (in.op == Op::Solid) {
                dvec4& below = layers.empty() ? color : layers.back().above;
                below = over(double(in.opacity) * dvec4(std::bit_cast<glm::vec4>(asset_.data[in.argument])),
                             below);
            } else if (in.op == Op::Linear || in.op == Op::Radial) {
                layers.push_back({in, dvec4(0), layers.empty() ? color : dvec4(0)});
            } else {
                return std::nullopt;
            }
        }
        return layers.empty() ? std::nullopt : make(layers);
    }

private:
    std::optional<PaintWords> make(std::span<const GradientLayer> layers) {
        std::vector<Texel> all;
        std::uint32_t count = 0;
        for (const GradientLayer& layer : layers) {
            const std::optional<std::vector<Texel>> made = texelsOf(layer);
            if (!made || texels_.size() + all.size() > maxPlainTexels)
                return std::nullopt;
            if (isOpaque(made->front()[3])) {
                all.clear();
                count = 0;
            }
            all.insert(all.end(), made->begin(), made->end());
            ++count;
        }
        if (count >> (32 - plainTexelBits) != 0)
            return std::nullopt;
        const auto first = std::uint32_t(texels_.size());
        texels_.insert(texels_.end(), all.begin(), all.end());
        return PaintWords{first | count << plainTexelBits, plainTag};
    }

    std::optional<std::vector<Texel>> texelsOf(const GradientLayer& layer) {
        const Instruction& in = layer.gradient;
        const auto gradient = asset::recordAt<Gradient>(asset_.data, in.argument);
        if (gradient.spread == Spread::Repeat || gradient.stopCount > maxPlainStops)
            return std::nullopt;
        const std::optional<LayerForm> form =
            in.op == Op::Radial ? radialForm(gradient) : std::optional(linearForm(gradient));
        if (!form || (form->start > 0 && gradient.spread == Spread::Reflect))
            return std::nullopt;
        // Of hostile files.
        if (!form->isFinite())
            return std::nullopt;
        const std::optional<std::uint32_t> table = tableOf(layer, gradient, form->start);
        if (!table)
            return std::nullopt;
        const std::uint32_t reflected = gradient.spread == Spread::Reflect ? reflectedBit : 0;
        const auto bits = [](float v) { return std::bit_cast<std::uint32_t>(v); };
        std::vector<Texel> texels{{bits(form->first[0]), bits(form->first[1]), bits(form->first[2]),
                                   *table | form->bits | reflected}};
        if (in.op == Op::Radial)
            texels.push_back(std::bit_cast<Texel>(form->second));
        return texels;
    }

    /// Where it begins, and its size: bits of the word of a layer.
    std::optional<std::uint32_t> tableOf(const GradientLayer& layer, const Gradient& gradient, double start) {
        const Instruction& in = layer.gradient;
        const auto [found, isNew] =
            tables_.try_emplace({in.argument, in.opacity, start, wordsOf(layer.above), wordsOf(layer.below)});
        if (isNew && texels_.size() <= maxPlainTexels)
            if (const std::optional<std::vector<Texel>> table =
                    TableSource(asset_.data, in.argument, gradient, start, double(in.opacity), layer.above,
                                layer.below)
                        .table()) {
                found->second = std::uint32_t(texels_.size()) |
                                std::uint32_t(std::bit_width(table->size()) - 1) << plainTexelBits;
                texels_.insert(texels_.end(), table->begin(), table->end());
            }
        return found->second;
    }

    bool isOpaque(std::uint32_t layerWord) const {
        const std::uint32_t first = layerWord & texelMask;
        const std::uint32_t size = 1u << (layerWord >> plainTexelBits & ((1u << segmentBits) - 1));
        return std::ranges::all_of(std::span(texels_).subspan(first, size), [](const Texel& segment) {
            return segment[1] >> 16 == 0xFFFF && segment[3] >> 16 == 0xFFFF;
        });
    }

    /// Of one gradient: its texel, opacity, start, and the colours above and below it.
    using TableKey = std::tuple<std::uint32_t, float, double, PaintWords, PaintWords>;

    const asset::AssetView& asset_;
    std::vector<Texel>& texels_;
    std::map<TableKey, std::optional<std::uint32_t>> tables_;
};

}  // namespace

PlainPaints plainPaints(const asset::AssetView& asset) {
    PlainPaints plain;
    PlainPrograms programs(asset, plain.texels);
    for (const asset::Paint& paint : asset.paints)
        plain.words.push_back(asset::isProgram(paint) ? programs.make(paint).value_or(PaintWords{})
                                                      : wordsOf(dvec4(std::bit_cast<glm::vec4>(paint))));
    return plain;
}

namespace {

dvec4 segmentColor(std::uint32_t redGreen, std::uint32_t blueAlpha) {
    return dvec4(redGreen & 0xFFFF, redGreen >> 16, blueAlpha & 0xFFFF, blueAlpha >> 16) / 65535.0;
}

/// Slopes along t: the least and the largest of each channel.
struct SlopeRange {
    dvec4 low{HUGE_VAL}, high{-HUGE_VAL};

    void add(const dvec4& slope) {
        low = glm::min(low, slope);
        high = glm::max(high, slope);
    }
    double width() const {
        const dvec4 d = high - low;
        return std::max({d.r, d.g, d.b, d.a, 0.0});
    }
};

/// A layer as it is drawn.
class DrawnLayer {
public:
    DrawnLayer(std::span<const Texel> texels, std::size_t first)
        : word_(texels[first][3]),
          table_(
              texels.subspan(word_ & texelMask, 1u << (word_ >> plainTexelBits & ((1u << segmentBits) - 1)))),
          row_(numbersOf(texels[first])),
          other_(isRadial() ? numbersOf(texels[first + 1]) : dvec4(0)) {}

    std::size_t size() const { return isRadial() ? 2 : 1; }
    bool operator==(const DrawnLayer& other) const {
        return (word_ & ~texelMask) == (other.word_ & ~texelMask) && row_.x == other.row_.x &&
               row_.y == other.row_.y && row_.z == other.row_.z && other_ == other.other_ &&
               std::ranges::equal(table_, other.table_);
    }

    double bendNear(const asset::PixelsNear& pixels) const {
        const dvec2 across(other_), along(row_);
        const double x = glm::dot(along, pixels.middle) + row_.z,
                     y = glm::dot(across, pixels.middle) + other_.z;
        const double sum = glm::dot(along, along) + glm::dot(across, across);
        const double product = std::abs(along.x * across.y - along.y * across.x);
        const double root = std::sqrt(std::max(0.25 * sum * sum - product * product, 0.0));
        const double stretch = std::sqrt(0.5 * sum + root), slope = stretch * (1 + other_.w);
        const double t = isRadial() ? std::hypot(x, y) + other_.w * x : x;
        const double reach = slope * (pixels.radius + 0.5 * pixels.pixel);
        SlopeRange range;
        addSlopes(range, isRadial() ? std::max(t - reach, 0.0) : t - reach, t + reach);
        // The shader has the mean over a pixel at the tip of a round cone. That of another is at most a fold.
        if (isRadial() && t < reach && stretch * stretch > maxOblong * product)
            range.add(-range.high);
        return slope * range.width();
    }

private:
    static constexpr double maxOblong = 1.25;

    static dvec4 numbersOf(const Texel& texel) { return dvec4(std::bit_cast<glm::vec4>(texel)); }
    bool isRadial() const { return (word_ & radialBit) != 0; }

    void addSlopes(SlopeRange& range, double from, double to) const {
        if ((word_ & reflectedBit) != 0) {
            const bool isFolded = std::floor(from) != std::floor(to);
            const double period = 2 * std::floor(0.5 * from), low = from - period, high = to - period;
            addSegments(range,
                        isFolded  ? 0
                        : low > 1 ? 2 - high
                                  : low,
                        isFolded  ? 1
                        : low > 1 ? 2 - low
                                  : high);
            if (isFolded) {
                range.add(-range.low);
                range.add(-range.high);
            }
            return;
        }
        if (from < 0 || to > 1)
            range.add(dvec4(0));
        addSegments(range, from, to);
    }
    void addSegments(SlopeRange& range, double from, double to) const {
        const auto count = double(table_.size());
        const auto index = [&](double t) {
            return std::size_t(glm::clamp(std::floor(t * count), 0.0, count - 1));
        };
        for (std::size_t i = index(from); from <= 1 && to >= 0 && i <= index(to); ++i) {
            const Texel& ends = table_[i];
            range.add(count * (segmentColor(ends[2], ends[3]) - segmentColor(ends[0], ends[1])));
        }
    }

    std::uint32_t word_;
    std::span<const Texel> table_;
    dvec4 row_, other_;
};

}  // namespace

bool isSame(const PlainPaints& a, const PlainPaints& b, std::size_t paint) {
    const PaintWords &one = a.words[paint], &other = b.words[paint];
    if (!isPlainProgram(one) || !isPlainProgram(other))
        return isPlainProgram(one) == isPlainProgram(other);
    const std::uint32_t count = one[0] >> plainTexelBits;
    if (count != other[0] >> plainTexelBits)
        return false;
    std::size_t i = one[0] & texelMask, j = other[0] & texelMask;
    for (std::uint32_t left = count; left != 0; --left) {
        const DrawnLayer first(a.texels, i), second(b.texels, j);
        if (first != second)
            return false;
        i += first.size();
        j += second.size();
    }
    return true;
}

double bendNear(std::span<const Texel> texels, const PaintWords& program, const asset::PixelsNear& pixels) {
    double bend = 0;
    std::size_t next = program[0] & texelMask;
    for (std::uint32_t left = program[0] >> plainTexelBits; left != 0; --left) {
        const DrawnLayer layer(texels, next);
        bend += layer.bendNear(pixels);
        next += layer.size();
    }
    return bend;
}

}  // namespace vtm::gl
