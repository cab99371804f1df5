/// \file
/// Filling and stroking (specification section 8.8).
#pragma once

#include "api/openvg/draw/path_mask.hpp"
#include "api/openvg/draw/path_masks.hpp"
#include "api/openvg/state/context.hpp"

namespace vtm::openvg {

/// Throws for what is no bitwise OR of VGPaintMode values.
void requirePaintModes(VGbitfield modes);

/// Whether a state's strokes have a width.
bool hasStroke(const State& state);

/// Of a state that hasStroke().
StrokeParameters strokeParameters(const State& state);

/// A path filled or stroked as a state says; strokes only of a state that hasStroke().
PathMask& maskOf(const State& state, Path& path, VGPaintMode mode);

/// Gives the pixels of `clip` that a path covers, filled or stroked as the context's state says: exactly, or
/// by centres where antialiasing is off. Nothing for a stroke without width.
void coverPath(const Context& context, Path& path, VGPaintMode mode, const glm::mat3& toSurface,
               const Rectangle& clip, const RowSink& row, GlyphCache* cache = nullptr);

/// Draws it with the current paints. `cache`: of a glyph, which is drawn again and again.
void drawPath(Context& context, Path& path, VGbitfield modes, const glm::mat3& toSurface,
              GlyphCache* cache = nullptr);

}  // namespace vtm::openvg
