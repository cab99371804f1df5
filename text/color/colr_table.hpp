/// \file
/// The table COLR, version 1. Source: OpenType 1.9.1. Debian 12's FreeType is built without it, and HarfBuzz
/// reads it from version 7 on. Numbers of the variable formats are those of the default instance.
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

}  // namespace vtm::text
