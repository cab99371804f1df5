/// \file
/// Composite modes of COLR version 1 as groups. Source: Compositing and Blending Level 1, section 9.
#pragma once

#include <vtm/scene/scene.hpp>

namespace vtm::text {

/// As COLR numbers them.
enum class CompositeMode {
    Clear,
    Source,
    Backdrop,
    SourceOver,
    BackdropOver,
    SourceIn,
    BackdropIn,
    SourceOut,
    BackdropOut,
    SourceAtop,
    BackdropAtop,
    Xor,
    Plus,
    Screen,
    Overlay,
    Darken,
    Lighten,
    ColorDodge,
    ColorBurn,
    HardLight,
    SoftLight,
    Difference,
    Exclusion,
    Multiply,
    Hue,
    Saturation,
    Color,
    Luminosity
};

/// `source` composited with `backdrop`, as nodes to be drawn over nothing. `everywhere` covers both.
scene::NodeList composited(CompositeMode mode, scene::NodeList source, scene::NodeList backdrop,
                           const scene::Item& everywhere);

}  // namespace vtm::text
