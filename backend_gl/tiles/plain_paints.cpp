#include "backend_gl/tiles/plain_paints.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <span>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <vtm/limits/limits.hpp>
#include "asset/records.hpp"
#include "raster/blend.hpp"

namespace vtm::gl {

namespace {

using asset::Blend;
using asset::Gradient;
using asset::GradientStop;
using asset::Instruction;
using asset::Op;
using asset::Spread;
using asset::Texel;
using glm::dvec2;
using glm::dvec4;

constexpr std::uint32_t texelMask = (1u << plainTexelBits) - 1;

/// Of a paint. A program of more takes longer to make than to run.
constexpr std::size_t maxLayers = 32;
/// Of a gradient, and of all periods near a tile.
constexpr std::uint32_t maxPlainStops = 256;
/// A ramp that differs by less near a tile has one colour there.
constexpr double sameColor = 0.5 * maxTableError;
/// Of t, which shaders know to 2^-24 of this: a hundredth of a segment.
constexpr double maxPlace = 0x1p16;

PaintWords wordsOf(const dvec4& color) {
    const auto channel = [](double value) {
        return std::uint32_t(std::lround(glm::clamp(value, 0.0, 1.0) * 65535));
    };
    return {channel(color.r) | channel(color.g) << 16, channel(color.b) | channel(color.a) << 16};
}

/// Premultiplied.
dvec4 over(const dvec4& source, const dvec4& backdrop) { return source + (1 - source.a) * backdrop; }

double largest(const dvec4& c) { return std::max({c.r, c.g, c.b, c.a}); }
bool isAlike(const dvec4& a, const dvec4& b, double most) { return largest(glm::abs(a - b)) <= most; }
bool isClear(const dvec4& c) { return c == dvec4(0); }

// ---- Gradients -------------------------------------------------------------------------------------

/// Offsets, on both sides of which a ramp's colour is asked for.
constexpr double besideStop = 1e-6;

/// Straight colours by offset.
class Ramp {
public:
    Ramp(std::span<const Texel> data, std::uint32_t texel, const Gradient& gradient)
        : spread_(gradient.spread) {
        for (std::uint32_t i = 0; i < gradient.stopCount; ++i) {
            const auto stop = asset::recordAt<GradientStop>(
                data, texel + std::uint32_t(asset::GradientView::headTexels) + i);
            offsets_.push_back(double(stop.offset));
            colors_.push_back(dvec4(stop.rgba[0], stop.rgba[1], stop.rgba[2], stop.rgba[3]) / 65535.0);
        }
    }

    /// Premultiplied.
    dvec4 at(double u) const {
        const dvec4 c = straight(spread_ == Spread::Reflect  ? 1 - std::abs(1 - (u - 2 * std::floor(u / 2)))
                                 : spread_ == Spread::Repeat ? u - std::floor(u)
                                                             : u);
        return {c.a * c.r, c.a * c.g, c.a * c.b, c.a};
    }

    /// Offsets in a range at which the ramp may bend or jump; nothing where they are many.
    std::optional<std::vector<double>> corners(double from, double to) const {
        std::vector<double> found;
        const double first = spread_ == Spread::Pad ? 0 : std::floor(from),
                     last = spread_ == Spread::Pad ? 0 : std::floor(to);
        if (!((last - first + 1) * double(offsets_.size()) <= maxPlainStops))
            return std::nullopt;
        const auto add = [&](double u) {
            if (u >= from && u <= to)
                found.push_back(u);
        };
        for (double period = first; period <= last; ++period) {
            const bool isBackwards = spread_ == Spread::Reflect && std::fmod(period, 2) != 0;
            for (const double offset : offsets_)
                add(period + (isBackwards ? 1 - offset : offset));
            if (spread_ != Spread::Pad)
                add(period);
        }
        return found;
    }

    bool isOpaque() const {
        return std::ranges::all_of(colors_, [](const dvec4& c) { return c.a == 1; });
    }

private:
    dvec4 straight(double u) const {
        const auto next = std::size_t(std::ranges::upper_bound(offsets_, u) - offsets_.begin());
        if (next == 0 || next == offsets_.size())
            return next == 0 ? colors_.front() : colors_.back();
        const double from = offsets_[next - 1];
        return glm::mix(colors_[next - 1], colors_[next], (u - from) / (offsets_[next] - from));
    }

    Spread spread_;
    std::vector<double> offsets_;
    std::vector<dvec4> colors_;
};

struct Interval {
    double from, to;

    /// Distances from 0.
    double least() const { return std::max({from, -to, 0.0}); }
    double most() const { return std::max(std::abs(from), std::abs(to)); }
};

/// t of a point in tile sides: a linear function, or |q| + e q.x of two. The offset is u = t - start.
struct Place {
    std::array<double, 3> x{}, y{};
    double e = 0, start = 0;
    bool isRadial = false;

    static Interval intervalOf(const std::array<double, 3>& row, double margin) {
        const double middle = valueOf(row, dvec2(0.5)), reach = 0.5 * (std::abs(row[0]) + std::abs(row[1])) +
                                                                margin * std::hypot(row[0], row[1]);
        return {middle - reach, middle + reach};
    }
    static double valueOf(const std::array<double, 3>& row, dvec2 p) {
        return row[0] * p.x + row[1] * p.y + row[2];
    }
    double at(dvec2 p) const {
        const double along = valueOf(x, p);
        return isRadial ? std::hypot(along, valueOf(y, p)) + e * along : along;
    }
    /// What it is at the points of the unit square and up to `margin` away from them.
    Interval over(double margin) const {
        const Interval along = intervalOf(x, margin);
        if (!isRadial)
            return along;
        const Interval across = intervalOf(y, margin);
        const double middle = at(dvec2(0.5)), reach = slope() * (std::sqrt(0.5) + margin);
        return {std::max(std::hypot(along.least(), across.least()) + e * along.from, middle - reach),
                std::min(std::hypot(along.most(), across.most()) + e * along.to, middle + reach)};
    }
    /// What t changes by over a tile's side, at most, and of a cone that without e.
    double slope() const { return stretch() * (1 + e); }
    double stretch() const {
        if (!isRadial)
            return std::hypot(x[0], x[1]);
        const double sum = x[0] * x[0] + x[1] * x[1] + y[0] * y[0] + y[1] * y[1];
        return std::sqrt(0.5 * sum + std::sqrt(std::max(0.25 * sum * sum - area() * area(), 0.0)));
    }
    double area() const { return std::abs(x[0] * y[1] - x[1] * y[0]); }
    bool isFinite() const {
        const auto finite = [](double v) { return std::isfinite(float(v)); };
        return std::ranges::all_of(x, finite) && std::ranges::all_of(y, finite) && finite(e);
    }
};

/// Where the circles of a radial gradient lie within each other by this much; as in steepness.cpp.
constexpr double minCircleGap = 0.1;

/// With d = p - f, f along the x axis, the offset is u = b + sqrt(b² + c), b = (dx |f| - fr (1-fr)) / a,
/// c = (|d|² - fr²) / a, a = (1-fr)² - |f|² (gradient.cpp). Under the root stands a sum of two squares:
///     q = (((1-fr) dx - |f| fr) / a, dy / sqrt(a)),   u = |q| + e q.x - k,
/// e = |f| / (1-fr), k = fr / (1-fr).
std::optional<Place> placeOf(const Gradient& g, bool isRadial, const TileFrame& frame) {
    const auto& m = g.matrix;
    const auto row = [&](dvec2 direction, dvec2 origin, double factor, double more) {
        const dvec2 linear(glm::dot(direction, dvec2(m[0], m[1])), glm::dot(direction, dvec2(m[2], m[3])));
        const double at = glm::dot(linear, frame.corner) + glm::dot(direction, dvec2(m[4], m[5]) - origin);
        return std::array<double, 3>{factor * frame.side * linear.x, factor * frame.side * linear.y,
                                     factor * at + more};
    };
    Place place;
    place.isRadial = isRadial;
    if (!isRadial) {
        place.x = row({1, 0}, {0, 0}, 1, 0);
    } else {
        const dvec2 f(g.fx, g.fy);
        const double focus = glm::length(f), rest = 1 - double(g.fr);
        if (rest - focus < minCircleGap)
            return std::nullopt;
        const double a = rest * rest - focus * focus;
        const dvec2 axis = focus > 0 ? f / focus : dvec2(1, 0), across(-axis.y, axis.x);
        place.x = row(axis, f, rest / a, -focus * double(g.fr) / a);
        place.y = row(across, f, 1 / std::sqrt(a), 0);
        place.e = focus / rest;
        place.start = double(g.fr) / rest;
    }
    return place.isFinite() ? std::optional(place) : std::nullopt;
}

// ---- Layers ----------------------------------------------------------------------------------------

/// What is made of a colour c, with another one.
struct Step {
    enum class Kind {
        Scale,  ///< c times color.a
        Onto,   ///< c over the colour
        Under,  ///< the colour over c
        Mix,    ///< c mixed with the colour below it
        MixOn,  ///< the colour mixed with c below it
        Mask    ///< the colour times what the mask c leaves
    };
    Kind kind;
    dvec4 color;
    Blend blend = Blend::Normal;
    Op mask = Op::PopMaskAlpha;

    dvec4 operator()(const dvec4& c) const {
        switch (kind) {
            case Kind::Scale:
                return c * color.a;
            case Kind::Onto:
                return over(c, color);
            case Kind::Under:
                return over(color, c);
            case Kind::Mix:
                return dvec4(asset::blend(blend, glm::vec4(c), glm::vec4(color)));
            case Kind::MixOn:
                return dvec4(asset::blend(blend, glm::vec4(color), glm::vec4(c)));
            default:
                return color * double(asset::maskFactor(mask, glm::vec4(c)));
        }
    }
};

/// A colour, or a gradient and what is made of it.
struct PlainLayer {
    dvec4 color{0};
    std::shared_ptr<const Ramp> ramp;  ///< null: a colour
    Place place;
    Interval range{};  ///< of offsets in the tile's pixels
    bool isOpaque = false;
    std::vector<Step> steps;

    bool isColor() const { return !ramp; }
    dvec4 at(double u) const {
        dvec4 c = ramp->at(u);
        for (const Step& step : steps)
            c = step(c);
        return c;
    }
    void add(const Step& step) {
        if (isColor())
            color = step(color);
        else
            steps.push_back(step);
    }
};

using Layers = std::vector<PlainLayer>;

/// A layer over others. A colour is the lowest layer or part of one.
void put(Layers& layers, PlainLayer layer) {
    if (layer.isColor() ? layer.color.a >= 1 : layer.isOpaque)
        layers.clear();
    if (layer.isColor() && !layers.empty()) {
        layers.back().add({Step::Kind::Under, layer.color});
        return;
    }
    if (layers.size() == 1 && layers[0].isColor()) {
        layer.isOpaque = layer.isOpaque || layers[0].color.a >= 1;
        layer.add({Step::Kind::Onto, layers[0].color});
        layers.clear();
    }
    if (!layer.isColor() || !isClear(layer.color))
        layers.push_back(std::move(layer));
}

/// The layer, if it is one, or nothing, as a colour.
std::optional<PlainLayer> onlyLayer(const Layers& layers) {
    if (layers.size() > 1)
        return std::nullopt;
    return layers.empty() ? PlainLayer() : layers[0];
}

/// Two of which one is a colour: the other one with a step.
std::optional<PlainLayer> joined(const Layers& source, const Layers& backdrop, Step ofSource,
                                 Step ofBackdrop) {
    std::optional<PlainLayer> above = onlyLayer(source), below = onlyLayer(backdrop);
    if (!above || !below || (!above->isColor() && !below->isColor()))
        return std::nullopt;
    const bool isOpaque = ofSource.kind == Step::Kind::Mix &&
                          (above->isOpaque || below->isOpaque || (above->isColor() && above->color.a >= 1) ||
                           (below->isColor() && below->color.a >= 1));
    PlainLayer& kept = below->isColor() ? *above : *below;
    Step& step = below->isColor() ? ofSource : ofBackdrop;
    step.color = below->isColor() ? below->color : above->color;
    kept.isOpaque = isOpaque;
    kept.add(step);
    return kept;
}

/// Runs a program near a tile.
class PlainProgram {
public:
    PlainProgram(const asset::AssetView& asset, const TileFrame& frame) : asset_(asset), frame_(frame) {}

    std::optional<Layers> run(const asset::Paint& program) {
        for (std::uint32_t i = 0; i < program[1]; ++i) {
            limits::check();
            if (!execute(asset::recordAt<Instruction>(asset_.data, program[0] + i)) ||
                stack_.back().size() > maxLayers)
                return std::nullopt;
        }
        return std::move(stack_.back());
    }

private:
    bool execute(const Instruction& in) {
        switch (in.op) {
            case Op::Push:
                stack_.emplace_back();
                return true;
            case Op::Pop:
                return pop(in);
            case Op::PopMaskLuminance:
            case Op::PopMaskLinear:
            case Op::PopMaskAlpha:
                return popMask(in);
            case Op::Solid: {
                PlainLayer layer;
                layer.color = double(in.opacity) * dvec4(std::bit_cast<glm::vec4>(asset_.data[in.argument]));
                put(stack_.back(), std::move(layer));
                return true;
            }
            case Op::Linear:
            case Op::Radial:
                return in.opacity == 0 || drawGradient(in);
            default:
                return in.opacity == 0;
        }
    }

    Layers popped() {
        Layers layers = std::move(stack_.back());
        stack_.pop_back();
        return layers;
    }

    bool pop(const Instruction& in) {
        Layers source = popped();
        Layers& backdrop = stack_.back();
        if (in.opacity != 1) {
            if (source.size() > 1)
                return false;
            if (!source.empty())
                scale(source[0], double(in.opacity));
        }
        if (in.blend == Blend::Normal) {
            for (PlainLayer& layer : source)
                put(backdrop, std::move(layer));
            return true;
        }
        return replace(
            joined(source, backdrop, {Step::Kind::Mix, {}, in.blend}, {Step::Kind::MixOn, {}, in.blend}));
    }

    bool popMask(const Instruction& in) {
        const Layers mask = popped();
        Layers& masked = stack_.back();
        const std::optional<PlainLayer> only = onlyLayer(mask);
        if (!only)
            return false;
        if (only->isColor()) {
            const double factor = double(asset::maskFactor(in.op, glm::vec4(only->color)));
            if (factor == 0)
                masked.clear();
            if (masked.empty() || factor == 1)
                return true;
            if (masked.size() > 1)
                return false;
            scale(masked[0], factor);
            return true;
        }
        Step step{Step::Kind::Mask, {}};
        step.mask = in.op;
        return masked.empty() || (masked[0].isColor() && replace(joined(mask, masked, step, step)));
    }

    static void scale(PlainLayer& layer, double factor) {
        layer.isOpaque = layer.isOpaque && factor >= 1;
        layer.add({Step::Kind::Scale, dvec4(factor)});
    }

    bool replace(std::optional<PlainLayer> layer) {
        if (!layer)
            return false;
        stack_.back().clear();
        put(stack_.back(), std::move(*layer));
        return true;
    }

    bool drawGradient(const Instruction& in) {
        const auto gradient = asset::recordAt<Gradient>(asset_.data, in.argument);
        if (gradient.stopCount > maxPlainStops)
            return false;
        const std::optional<Place> place = placeOf(gradient, in.op == Op::Radial, frame_);
        if (!place)
            return false;
        PlainLayer layer;
        const Interval t = place->over(0.5 * frame_.pixel);
        layer.range = {(place->isRadial ? std::max(t.from, 0.0) : t.from) - place->start,
                       t.to - place->start};
        layer.ramp = std::make_shared<const Ramp>(asset_.data, in.argument, gradient);
        layer.place = *place;
        const std::optional<std::vector<double>> corners =
            layer.ramp->corners(layer.range.from, layer.range.to);
        if (!corners)
            return false;
        const dvec4 color = layer.ramp->at(0.5 * (layer.range.from + layer.range.to));
        const auto isSame = [&](double u) { return isAlike(layer.ramp->at(u), color, sameColor); };
        if (isSame(layer.range.from) && isSame(layer.range.to) &&
            std::ranges::all_of(*corners,
                                [&](double u) { return isSame(u - besideStop) && isSame(u + besideStop); })) {
            layer.ramp.reset();
            layer.color = color;
        } else {
            layer.isOpaque = layer.ramp->isOpaque();
        }
        if (in.opacity != 1)
            scale(layer, double(in.opacity));
        put(stack_.back(), std::move(layer));
        return true;
    }

    const asset::AssetView& asset_;
    TileFrame frame_;
    std::vector<Layers> stack_{1};
};

// ---- Tables ----------------------------------------------------------------------------------------

/// Slopes: the least and the largest of each channel.
struct SlopeRange {
    dvec4 low{HUGE_VAL}, high{-HUGE_VAL};

    void add(const dvec4& slope) {
        low = glm::min(low, slope);
        high = glm::max(high, slope);
    }
    double width() const { return std::max(largest(high - low), 0.0); }
    double most() const { return std::max(largest(glm::max(glm::abs(low), glm::abs(high))), 0.0); }
};

/// A layer's ramp near a tile, in segments of equal length.
class Table {
public:
    /// The coarsest that is near enough.
    static std::optional<Table> make(const PlainLayer& layer) {
        for (int segments = 1; segments <= maxSegments; segments *= 2)
            if (Table table(layer, segments); table.isNear(layer))
                return table;
        return std::nullopt;
    }

    /// Segments of t, by unit of the offset.
    double scale() const { return scale_; }
    /// The number of the first texel's segment. One on either side is there for roundings.
    std::int64_t first() const { return first_ - 1; }
    std::vector<Texel> texels(const PlainLayer& layer) const {
        std::vector<Texel> texels;
        PaintWords from = wordsOf(layer.at(offset(double(first_ - 1))));
        for (std::int64_t i = first_ - 1; i <= last_ + 1; ++i) {
            const PaintWords to = wordsOf(layer.at(offset(double(i + 1))));
            texels.push_back({from[0], from[1], to[0], to[1]});
            from = to;
        }
        return texels;
    }
    /// By t.
    SlopeRange slopes(const PlainLayer& layer) const {
        SlopeRange slopes;
        for (std::int64_t i = first_; i <= last_; ++i)
            slopes.add(layer.at(offset(double(i + 1))) - layer.at(offset(double(i))));
        return slopes;
    }

private:
    Table(const PlainLayer& layer, int segments)
        : scale_(segments / (layer.range.to - layer.range.from)), start_(layer.place.start) {
        const double from = std::floor(place(layer.range.from)), to = std::floor(place(layer.range.to));
        if (std::abs(from) < maxPlace && std::abs(to) < maxPlace) {
            first_ = std::int64_t(from);
            last_ = std::int64_t(to);
        }
    }
    double place(double u) const { return (u + start_) * scale_; }
    double offset(double place) const { return place / scale_ - start_; }

    /// Within a segment a ramp is furthest from its chord at a stop, or about in the middle, as it is a
    /// quadratic between stops. Blend modes may jump anywhere.
    bool isNear(const PlainLayer& layer) const {
        if (last_ < first_)
            return false;
        const std::optional<std::vector<double>> corners =
            layer.ramp->corners(offset(double(first_)), offset(double(last_ + 1)));
        if (!corners)
            return false;
        for (const double corner : *corners)
            for (const double u : {corner - besideStop, corner + besideStop})
                if (const double i = std::floor(place(u));
                    i >= double(first_) && i <= double(last_) &&
                    !isNear(layer.at(offset(i)), layer.at(offset(i + 1)), place(u) - i, layer.at(u)))
                    return false;
        dvec4 from = layer.at(offset(double(first_)));
        for (std::int64_t i = first_; i <= last_; ++i) {
            const dvec4 to = layer.at(offset(double(i + 1)));
            for (const double share : {0.5, 0.25, 0.75})
                if (!isNear(from, to, share, layer.at(offset(double(i) + share))))
                    return false;
            from = to;
        }
        return true;
    }
    static bool isNear(const dvec4& from, const dvec4& to, double share, const dvec4& color) {
        return isAlike(glm::mix(from, to, share), color, maxTableError);
    }

    double scale_, start_;
    std::int64_t first_ = 0, last_ = -1;
};

/// The shader has the mean over a pixel at the tip of a round cone. That of another is at most a fold.
constexpr double maxOblong = 1.25;

/// Puts a layer into a paint: its texels into `layers` and `tables`. Its word counts from the beginning of
/// `tables`.
bool addTo(PlainPaint& paint, const PlainLayer& layer, const TileFrame& frame, std::vector<Texel>& layers,
           std::vector<Texel>& tables) {
    const std::optional<Table> table = Table::make(layer);
    if (!table)
        return false;
    const double scale = table->scale(), slope = scale * layer.place.slope() * frame.pixel;
    SlopeRange slopes = table->slopes(layer);
    paint.change += slope * slopes.most();
    const bool isAtTip = layer.place.isRadial && layer.range.from <= -layer.place.start;
    if (const double stretch = layer.place.stretch();
        isAtTip && stretch * stretch > maxOblong * layer.place.area())
        slopes.add(-slopes.high);
    paint.bend += slope * slopes.width();
    const auto bits = [&](double v) { return std::bit_cast<std::uint32_t>(float(v)); };
    const std::array<double, 3>& x = layer.place.x;
    const auto word = std::uint32_t(std::int64_t(tables.size()) - table->first()) & texelMask;
    layers.push_back({bits(scale * x[0]), bits(scale * x[1]), bits(scale * x[2]),
                      word | (layer.place.isRadial ? radialBit : 0)});
    if (const std::array<double, 3>& y = layer.place.y; layer.place.isRadial)
        layers.push_back({bits(scale * y[0]), bits(scale * y[1]), bits(scale * y[2]), bits(layer.place.e)});
    const std::vector<Texel> texels = table->texels(layer);
    tables.insert(tables.end(), texels.begin(), texels.end());
    ++paint.layers;
    return true;
}

/// Adds to the words of layers, so many texels.
void moveTables(std::span<Texel> layers, std::uint32_t by) {
    for (std::size_t i = 0; i < layers.size(); i += (layers[i][3] & radialBit) != 0 ? 2 : 1)
        layers[i][3] = ((layers[i][3] + by) & texelMask) | (layers[i][3] & ~texelMask);
}

}  // namespace

std::optional<PlainPaint> plainPaint(const asset::AssetView& asset, std::uint32_t paint,
                                     const TileFrame& frame) {
    PlainPaint plain;
    if (!asset::isProgram(asset.paints[paint])) {
        plain.color = solidWords(asset.paints[paint]);
        return plain;
    }
    const std::optional<Layers> layers = PlainProgram(asset, frame).run(asset.paints[paint]);
    if (!layers)
        return std::nullopt;
    if (layers->empty() || layers->front().isColor()) {
        plain.color = wordsOf(layers->empty() ? dvec4(0) : layers->front().color);
        return plain;
    }
    std::vector<Texel> tables;
    for (const PlainLayer& layer : *layers)
        if (!addTo(plain, layer, frame, plain.texels, tables))
            return std::nullopt;
    moveTables(plain.texels, std::uint32_t(plain.texels.size()));
    plain.texels.insert(plain.texels.end(), tables.begin(), tables.end());
    return plain;
}

PaintWords append(const PlainPaint& paint, std::vector<Texel>& texels) {
    if (paint.layers == 0)
        return paint.color;
    const std::size_t first = texels.size();
    texels.insert(texels.end(), paint.texels.begin(), paint.texels.end());
    std::size_t end = first;
    for (std::uint32_t left = paint.layers; left != 0; --left)
        end += (texels[end][3] & radialBit) != 0 ? 2 : 1;
    moveTables(std::span(texels).subspan(first, end - first), std::uint32_t(first));
    return {std::uint32_t(first) | paint.layers << plainTexelBits, plainTag};
}

PaintWords solidWords(const asset::Paint& paint) {
    return asset::isProgram(paint) ? PaintWords{} : wordsOf(dvec4(std::bit_cast<glm::vec4>(paint)));
}

PaintWords TileWords::of(std::uint32_t paint) const {
    const auto found =
        std::ranges::lower_bound(programs_, paint, {}, &std::pair<std::uint32_t, PaintWords>::first);
    return found != programs_.end() && found->first == paint ? found->second : solidWords(paints_[paint]);
}

}  // namespace vtm::gl
