#include "backend_gl/tiles/plain_paints.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include <glm/common.hpp>
#include <glm/vec4.hpp>

#include "backend_gl/tiles/plain_layers.hpp"

namespace vtm::gl {

namespace {

using asset::Texel;
using glm::dvec4;
using plain::besideStop;
using plain::isAlike;
using plain::largest;
using plain::PlainLayer;

constexpr std::uint32_t texelMask = (1u << plainTexelBits) - 1;
/// Of t, which shaders know to 2^-24 of this: a hundredth of a segment.
constexpr double maxPlace = 0x1p16;

PaintWords wordsOf(const dvec4& color) {
    const auto channel = [](double value) {
        return std::uint32_t(std::lround(glm::clamp(value, 0.0, 1.0) * 65535));
    };
    return {channel(color.r) | channel(color.g) << 16, channel(color.b) | channel(color.a) << 16};
}

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
    const std::optional<plain::Layers> layers = plain::plainLayers(asset, asset.paints[paint], frame);
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

const PaintWords* TileWords::put(std::uint32_t paint) const {
    const auto found =
        std::ranges::lower_bound(programs_, paint, {}, &std::pair<std::uint32_t, PaintWords>::first);
    return found != programs_.end() && found->first == paint ? &found->second : nullptr;
}

PaintWords TileWords::of(std::uint32_t paint) const {
    const PaintWords* const words = put(paint);
    return words != nullptr ? *words : solidWords(paints_[paint]);
}

PaintKind TileWords::kindOf(std::uint32_t paint) const {
    if (const PaintWords* const words = put(paint))
        return (*words)[1] == plainTag ? PaintKind::Plain : PaintKind::Solid;
    return asset::isProgram(paints_[paint]) ? PaintKind::Program : PaintKind::Solid;
}

}  // namespace vtm::gl
