/// \file
/// The table COLR, version 1, and its paints that transform another one. Source: OpenType 1.9.1. Debian 12's
/// FreeType is built without it, and HarfBuzz reads it from version 7 on. Numbers of the variable formats are
/// those of the default instance.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "text/font.hpp"
#include "text/fonts/table_cursor.hpp"

namespace vtm::text {

struct ClipBox {
    scene::Point min, max;  ///< y down
};

class ColrTable {
public:
    explicit ColrTable(std::span<const std::uint8_t> table) : table_(table) {}

    /// Where a glyph's paint begins; nothing for glyphs without one.
    std::optional<std::size_t> paintOf(GlyphId glyph) const;
    std::optional<ClipBox> clipBoxOf(GlyphId glyph) const;
    /// The paint of a layer of all glyphs' list.
    std::optional<std::size_t> layer(std::uint32_t index) const;
    TableCursor at(std::size_t offset) const { return {table_, offset}; }

private:
    /// The list whose offset the header has at `field`; nothing where there is none.
    std::optional<std::size_t> list(std::size_t field) const;

    std::span<const std::uint8_t> table_;
};

/// As COLR numbers them; the variable format of most is the next number.
enum class PaintFormat {
    ColrLayers = 1,
    Solid = 2,
    LinearGradient = 4,
    RadialGradient = 6,
    SweepGradient = 8,
    Glyph = 10,
    ColrGlyph = 11,
    Transform = 12,
    Translate = 14,
    Scale = 16,
    ScaleAround = 18,
    ScaleUniform = 20,
    ScaleUniformAround = 22,
    Rotate = 24,
    RotateAround = 26,
    Skew = 28,
    SkewAround = 30,
    Composite = 32
};

/// What the numbers of the paint say, from after its child; `at` is where the paint begins. y down. Nothing
/// for formats that do not transform.
std::optional<scene::Affine> readTransform(const ColrTable& table, PaintFormat format, std::size_t at,
                                           TableCursor from);

scene::Point readPoint(TableCursor& from);  ///< two words, turned y down

}  // namespace vtm::text
