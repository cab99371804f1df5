/// \file
/// Paints: what fills a shape. Source: SVG 2 section 14, OpenVG 1.1 section 9.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include <vtm/image/bitmap.hpp>
#include <vtm/scene/affine.hpp>
#include <vtm/scene/nested.hpp>
#include <vtm/scene/path.hpp>

#pragma GCC visibility push(default)

namespace vtm::scene {

struct Group;

/// Straight (not premultiplied) sRGB-encoded colour, each channel in [0, 1].
struct Color {
    float r = 0, g = 0, b = 0, a = 1;
    friend bool operator==(const Color&, const Color&) = default;
};

enum class Spread { Pad, Reflect, Repeat };

/// Offsets in [0, 1], not decreasing. Colours are interpolated straight, in sRGB bytes.
struct GradientStop {
    float offset;
    Color color;
};

/// `transform` of each paint maps the paint's own space to the path's space (before the item's
/// transform).

struct LinearGradient {
    Point start, end;                 ///< distinct
    std::vector<GradientStop> stops;  ///< at least two; fewer are a Solid
    Spread spread = Spread::Pad;
    Affine transform = identity;
};

/// SVG 2's two circles: offset 0 on the focal circle, 1 on the end circle.
struct RadialGradient {
    Point center;
    double radius;           ///< > 0
    Point focus;             ///< strictly inside the end circle
    double focalRadius = 0;  ///< in [0, radius)
    std::vector<GradientStop> stops;
    Spread spread = Spread::Pad;
    Affine transform = identity;
};

/// A group repeated with the period of a rectangle, clipped to it in each tile.
struct Pattern {
    Point min, max;       ///< the tile, in pattern space; max > min in both axes
    Link<Group> content;  ///< absolute in pattern space
    Affine transform = identity;
};

/// How a bitmap is read at a pixel. All interpolate premultiplied colours; docs/scene.md has the formulas.
enum class ImageFilter {
    Nearest,    ///< the bitmap's pixel at the point
    Bilinear,   ///< of the 2 × 2 pixels next to the point; aliases where the bitmap is shown smaller
    Trilinear,  ///< the same while magnified; smaller, between levels of means over 2^l × 2^l pixels
    Bicubic     ///< as Trilinear, but with Catmull-Rom's 4 × 4 kernel where the bitmap itself is read
};

/// A bitmap laid with pixel (0, 0)'s outer corner on the origin, one unit a pixel; beyond its
/// border the border pixels go on.
struct ImagePaint {
    std::shared_ptr<const image::Bitmap> bitmap;
    ImageFilter filter = ImageFilter::Trilinear;
    Affine transform = identity;
};

/// A procedural paint: GLSL ES 3.00 that the GL backend compiles into its fragment shaders. The text defines
///     vec4 NAME(vec2 p)
/// with the material's name: the premultiplied colour at point p of the material's own space. Functions
/// beside it share one name space with those of the picture's other materials; derivatives are undefined in
/// it.
struct Material {
    std::string name;  ///< a letter, then letters, digits and single underscores; one text a name in a scene
    std::string glsl;  ///< without zero bytes
    Color fallback;    ///< where no GLSL runs
    Affine transform = identity;
};
inline constexpr std::size_t maxMaterialName = 64, maxMaterialText = 65536;  ///< bytes

using Paint = std::variant<Color, LinearGradient, RadialGradient, Pattern, ImagePaint, Material>;

}  // namespace vtm::scene

#pragma GCC visibility pop
