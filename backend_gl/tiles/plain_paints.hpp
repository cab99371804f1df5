/// \file
/// Paints in a form that shaders draw quickly where they change little over a pixel
/// (shaders/tiles/plain_paint.glsl): layers over each other, each a gradient whose ramp is a table. They are
/// made for a tile, so only what the paint is near that matters.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>

#include <vtm/asset/asset.hpp>

namespace vtm::gl {

/// A paint as tiles have it. One colour: premultiplied red | green << 16, blue | alpha << 16, 16-bit unorm.
/// Layers: the tile's texel of the first | number of layers << plainTexelBits; plainTag, which is no
/// colour's. Others: 0.
using PaintWords = std::array<std::uint32_t, 2>;
inline constexpr unsigned plainTexelBits = 24;
inline constexpr std::uint32_t plainTag = 0xFFFF;

/// Of the word of a layer: the texel of segment 0 of its table in plainTexelBits, modulo their range, since
/// tables begin with other segments; whether the layer is radial.
inline constexpr std::uint32_t radialBit = 1u << 24;
/// Premultiplied: what a table may be off by. Of as many segments as this a table can have.
inline constexpr double maxTableError = 0.2 / 255;
inline constexpr int maxSegments = 512;

/// The points at which a tile's pixels ask for paints, in tile sides from its least corner: those of the unit
/// square, each with the pixel around it.
struct TileFrame {
    glm::dvec2 corner;  ///< of the picture
    double side;        ///< picture units
    double pixel;       ///< no two points of a pixel are further apart; tile sides
};

/// A paint near a tile.
struct PlainPaint {
    PaintWords color{};  ///< where there are no layers
    std::uint32_t layers = 0;
    std::vector<asset::Texel> texels;  ///< the layers, then their tables
    /// What a pixel changes a channel by, at most, and by how much slopes over it differ, times its width: 0
    /// where ramps are straight. All layers added.
    double change = 0, bend = 0;
};

/// A paint is plain near a tile if what it draws there are colours and gradients over each other, and tables
/// are near enough to their ramps. Colours are mixed into the tables of gradients beside them, and what lies
/// below an opaque layer is left out. A gradient that has one colour there is a colour. A group, a blend mode
/// or a mask is mixed into a table where one of its two sides has one colour and the other is one layer.
/// Hard stops that lie there are not plain, nor are images and materials.
///
/// - Layer, from the lowest on: three floats a, b, c and a word. t = a x + b y + c at a point, tile sides.
/// Radial:
///   a second texel with floats a', b', c', e, and t = length(t, a' x + b' y + c') + e t.
/// - Table: a texel for each segment, that is from t = i to i + 1, with the colours at its ends, PaintWords
///   both.
std::optional<PlainPaint> plainPaint(const asset::AssetView& asset, std::uint32_t paint,
                                     const TileFrame& frame);

/// Puts a paint's texels behind a tile's, and returns its words.
PaintWords append(const PlainPaint& paint, std::vector<asset::Texel>& texels);

/// Of a solid paint. Others: 0.
PaintWords solidWords(const asset::Paint& paint);

/// What a paint is near a tile.
enum class PaintKind : std::uint8_t { Solid, Plain, Program };

/// The paints of a tile as words: solid ones, and those that were put there.
class TileWords {
public:
    explicit TileWords(std::span<const asset::Paint> paints) : paints_(paints) {}

    /// In the order of their numbers.
    void put(std::uint32_t paint, const PaintWords& words) { programs_.emplace_back(paint, words); }
    PaintWords of(std::uint32_t paint) const;
    PaintKind kindOf(std::uint32_t paint) const;

private:
    const PaintWords* put(std::uint32_t paint) const;

    std::span<const asset::Paint> paints_;
    std::vector<std::pair<std::uint32_t, PaintWords>> programs_;
};

}  // namespace vtm::gl
