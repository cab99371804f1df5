/// \file
/// A page of text over a font's asset: which glyph stands where. Drawn as a texture (vtm/gl/text_texture.hpp)
/// it takes one byte a character in cells of one size, and eight bytes otherwise. Source: Ray et al. 2005,
/// the indirection texture of their font engine.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>

#include <vtm/asset/asset.hpp>

#pragma GCC visibility push(default)

namespace vtm::asset {

/// Straight sRGB, in [0, 1].
using PageColor = std::array<float, 4>;

/// A part of a glyph (GlyphPart) at a size, an angle and in a colour. Its colour replaces the ground's where
/// it is opaque, and is drawn over it where it is not.
struct PageSymbol {
    std::uint32_t map = 0;  ///< of the font's asset; 0: blank
    glm::dmat2 linear{1};   ///< from ems to page units
    PageColor color{0, 0, 0, 1};
    glm::dvec2 offset{0};    ///< from the origin where it stands to that of its map, page units
    std::uint16_t next = 0;  ///< in cells: another symbol in the same cell, of a larger index; 0: none
};

/// Outlines of glyphs on a page must not overlap each other: a pixel is a sum.
struct PageGlyph {
    std::uint16_t symbol = 0;  ///< of TextPage::symbols
    glm::dvec2 origin{0};      ///< page units
};

/// Cells of one size, with one glyph each.
struct PageCells {
    unsigned columns = 0, rows = 0;
    glm::dvec2 corner{0}, size{0};      ///< min corner of the first cell, and size of one; page units
    glm::dvec2 origin{0};               ///< of the glyph in its cell
    std::vector<std::uint8_t> symbols;  ///< row by row, of TextPage::symbols; 0 is blank
    std::vector<std::uint8_t> colors;   ///< likewise, of `palette`; empty: the symbols' own colours
    std::vector<PageColor> palette;
};

struct TextPage {
    double width = 0, height = 0;  ///< page units, y down
    PageColor ground{0, 0, 0, 0};
    std::vector<PageSymbol> symbols;  ///< symbols[0] is blank if there are cells
    std::vector<PageGlyph> glyphs;
    std::optional<PageCells> cells;
};

/// What a colour on a ground looks like, both straight: premultiplied.
PageColor colorOn(const PageColor& color, const PageColor& ground);

/// Throws std::invalid_argument, which names the record, unless every number is finite and in range, every
/// symbol and map exists, and matrices are regular. `font` must be valid.
void validate(const TextPage& page, const AssetView& font);

/// The page as an asset of its own, in which glyphs are instances: for engines that know no pages. Letters
/// that stick out of the page are drawn beyond it. Throws std::invalid_argument as validate() does, and if
/// the format cannot hold them.
Asset pageAsset(const TextPage& page, const AssetView& font);

}  // namespace vtm::asset

#pragma GCC visibility pop
