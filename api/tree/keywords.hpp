/// \file
/// The words of .vtmtree files that stand for values of enumerations, in the enumerations' order.
#pragma once

#include <array>
#include <string_view>

namespace vtm::keywords {

using Word = std::string_view;

inline constexpr std::array<Word, 3> caps{"butt", "round", "square"};
inline constexpr std::array<Word, 4> joins{"miter", "miter-clip", "round", "bevel"};
inline constexpr std::array<Word, 3> spreads{"pad", "reflect", "repeat"};
inline constexpr std::array<Word, 4> filters{"nearest", "bilinear", "trilinear", "bicubic"};
inline constexpr std::array<Word, 17> blends{
    "normal",      "multiply",   "screen",     "overlay",    "darken",      "lighten",
    "color-dodge", "color-burn", "hard-light", "soft-light", "difference",  "exclusion",
    "hue",         "saturation", "color",      "luminosity", "plus-lighter"};
/// Of masks; the third is luminance of linear light.
inline constexpr std::array<Word, 3> masks{"luminance", "alpha", "linear-luminance"};

/// Words that no definition may have for a name, since they may stand where a name may stand. Names of
/// colours are the others.
inline constexpr std::array<Word, 37> reserved{
    "vtmtree", "size",     "shape",     "clip",    "image",   "vtm",     "draw",      "select",
    "else",    "layer",    "mask",      "blend",   "opacity", "placed",  "transform", "within",
    "rect",    "circle",   "evenodd",   "stroke",  "cap",     "join",    "miter",     "dash",
    "phase",   "linear",   "radial",    "focus",   "pad",     "reflect", "repeat",    "pattern",
    "nearest", "bilinear", "trilinear", "bicubic", "material"};

}  // namespace vtm::keywords
