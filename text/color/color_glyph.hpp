/// \file
/// Glyphs that bring their own colours. Source: OpenType 1.9, tables COLR, CPAL, SVG, CBDT and sbix.
#pragma once

#include <hb.h>

#include <memory>
#include <optional>

#include "text/font.hpp"

namespace vtm::text {

/// What colour glyphs of a font are made of.
struct ColorSource {
    const Font& outlines;  ///< not synthesised
    scene::Color foreground;
    scene::Affine transform;  ///< from the outlines' space to the glyph's

    /// Of the first palette; the foreground for index 0xFFFF.
    scene::Color color(unsigned index, double alpha) const;
};

/// A table that can hold colour glyphs is there.
bool hasColorTables(hb_face_t* face);

/// COLR version 0: outlines, each in a colour. Nothing for glyphs without layers.
std::optional<scene::Group> layersOf(const ColorSource& source, GlyphId glyph);

/// COLR version 1: a graph of paints. Nothing for glyphs without one, and for graphs of more than
/// maxColorPaints paints.
std::optional<scene::Group> paintsOf(const ColorSource& source, GlyphId glyph);
inline constexpr int maxColorPaints = 1 << 14;

/// CBDT and sbix: the bitmap of the largest size.
std::optional<scene::Group> bitmapOf(const ColorSource& source, GlyphId glyph);

std::optional<SvgGlyph> svgOf(hb_face_t* face, GlyphId glyph);

scene::Item filled(std::shared_ptr<const scene::Path> path, const scene::Affine& transform,
                   scene::Paint paint);

}  // namespace vtm::text
