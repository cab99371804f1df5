/// \file
/// The paints of COLR version 1 that transform another one.
#pragma once

#include <optional>

#include "text/color/colr_table.hpp"

namespace vtm::text {

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
