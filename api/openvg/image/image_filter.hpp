/// \file
/// What a filter computes, for those that compute it elsewhere: the GPU's shaders.
#pragma once

#include <variant>
#include <vector>

#include <VG/openvg.h>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

#include "api/openvg/paint/color.hpp"

namespace vtm::openvg {

struct MatrixFilter {
    glm::mat4 matrix;
    Color added;
};

/// 256 entries, for the bytes of the channels.
struct TableFilter {
    std::vector<Color> entries;
    int channel;  ///< whose entry it is; -1: each channel is that of its own entry
};

/// Weighted sums of pixels, those outside of the image tiled.
struct Weighted {
    glm::ivec2 first;  ///< from a pixel to the first one that is weighted
    VGTilingMode tiling;
    Color fill;
    float scale = 1, bias = 0;  ///< of the sums
};
struct SumFilter : Weighted {
    std::vector<double> weights;  ///< row by row
    int columns;
};
/// Sums of sums.
struct SeparableFilter : Weighted {
    std::vector<double> across, up;
};

using FilterArithmetic = std::variant<MatrixFilter, TableFilter, SumFilter, SeparableFilter>;

struct ImageFilter {
    FilterArithmetic arithmetic;
    ColorSpace input, output;  ///< what is filtered, and what comes out
    VGbitfield channels;       ///< that are written, unless the image is grey
};

/// Every channel.
inline constexpr VGbitfield allChannels = VG_RED | VG_GREEN | VG_BLUE | VG_ALPHA;

}  // namespace vtm::openvg
