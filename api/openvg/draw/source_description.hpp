/// \file
/// What a source computes, for those that compute it elsewhere: the GPU's shaders.
#pragma once

#include <optional>
#include <variant>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

#include "api/openvg/paint/paint_color.hpp"

namespace vtm::openvg {

/// Value at p: dot(p - start, slope). Places come from pixels' centres by `fromSurface`, as everywhere here.
struct LinearField {
    glm::dmat3 fromSurface;
    glm::dvec2 start, slope;
    const ColorRamp* ramp;
};

/// With d = p - focus and f = focus - centre: (dot(d, f) + sqrt(r² |d|² - cross(d, f)²)) / (r² - |f|²).
struct RadialField {
    glm::dmat3 fromSurface;
    glm::dvec2 focus, fromCenter;
    double radius2;
    const ColorRamp* ramp;
};

/// An image's texels, as class Texels goes on with them outside.
struct TexelField {
    glm::dmat3 fromSurface;
    const Image* image;
    VGTilingMode tiling;
    Color fill;
    bool isSmooth;
};

struct SourceDescription {
    /// A premultiplied colour everywhere, or a field of them.
    std::variant<Color, LinearField, RadialField, TexelField> colors{Color(0)};
    /// What `colors` are in, and what the source gives: it differs if there is a transform or a factor.
    ColorSpace colorSpace, space;
    std::optional<ColorTransform> transform;
    std::optional<TexelField> factor;  ///< multiplies, channel by channel
};

}  // namespace vtm::openvg
