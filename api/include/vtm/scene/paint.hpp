/// \file
/// Paints, which give a shape its colour. `transform` of each paint maps the paint's own space to the path's
/// space, before the item's transform. Source: SVG 2 section 14, OpenVG 1.1 section 9.
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

/// How a gradient continues beyond offsets 0 and 1 (SVG's spreadMethod).
enum class Spread { Pad, Reflect, Repeat };

/// Colours are interpolated straight (not premultiplied), as sRGB-encoded values.
struct GradientStop {
    float offset;  ///< in [0, 1], not below that of the stop before
    Color color;
};

/// Offset 0 at `start`, 1 at `end`, constant perpendicular to the line between them.
struct LinearGradient {
    Point start, end;                 ///< must differ
    std::vector<GradientStop> stops;  ///< at least two; with fewer, use a Color
    Spread spread = Spread::Pad;
    Affine transform = identity;
};

/// SVG 2's two circles: offset 0 on the focal circle, 1 on the end circle. The circles between and beyond
/// fill the plane if the focal circle lies inside the end circle, else a cone, outside of which nothing is
/// drawn; of several circles through a point the one of the largest offset counts.
struct RadialGradient {
    Point center;                     ///< of the end circle
    double radius;                    ///< > 0
    Point focus;                      ///< of the focal circle, which must differ from the end circle
    double focalRadius = 0;           ///< >= 0
    std::vector<GradientStop> stops;  ///< at least two
    Spread spread = Spread::Pad;
    Affine transform = identity;
};

/// A group that is repeated with the period of the tile, and clipped to the tile in each repetition.
struct Pattern {
    Point min, max;       ///< the tile, in pattern space; max > min on both axes
    Link<Group> content;  ///< not null; its transforms are absolute in pattern space
    Affine transform = identity;
};

/// How a bitmap is sampled. All filters interpolate premultiplied colours; docs/scene.md has the formulas.
enum class ImageFilter {
    Nearest,    ///< the pixel at the point
    Bilinear,   ///< interpolates the 2 × 2 nearest pixels; aliases when minified
    Trilinear,  ///< Bilinear when magnified; when minified, the mean over the pixel, of levels 2^l × 2^l
                ///< pixels
    Bicubic     ///< as Trilinear, but the bitmap itself is read with a Catmull-Rom kernel of 4 × 4 pixels
};

/// A bitmap at one unit per pixel, the outer corner of pixel (0, 0) at the origin. Beyond the border the
/// border pixels are repeated.
struct ImagePaint {
    std::shared_ptr<const image::Bitmap> bitmap;  ///< not null, not empty; must not change while it is shared
    ImageFilter filter = ImageFilter::Trilinear;
    Affine transform = identity;
};

/// A procedural paint in GLSL ES 3.00, which the GL backend compiles into its fragment shaders. The text
/// defines
///     vec4 NAME(vec2 p)
/// with the material's name, which returns the premultiplied colour at point p of the material's own space.
/// Other functions in the text share one name space with those of the picture's other materials. Derivatives
/// (dFdx) are undefined.
struct Material {
    /// A letter, then letters, digits and single underscores, not beginning with gl_; at most maxMaterialName
    /// bytes. Materials of a scene with the same name must have the same text.
    std::string name;
    std::string glsl;  ///< at most maxMaterialText bytes, none of them zero
    Color fallback;    ///< the colour where no GLSL runs
    Affine transform = identity;
};
inline constexpr std::size_t maxMaterialName = 64, maxMaterialText = 65536;  ///< bytes

using Paint = std::variant<Color, LinearGradient, RadialGradient, Pattern, ImagePaint, Material>;

}  // namespace vtm::scene

#pragma GCC visibility pop
