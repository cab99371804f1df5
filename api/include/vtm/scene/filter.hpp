/// \file
/// Filters: graphs of operations on pictures. Source: Filter Effects Module Level 1. A filter is a value on a
/// group (vtm/scene/scene.hpp).
///
/// All lengths are in the filter's user space, which `Filter::transform` maps to the picture; units and
/// percentages are resolved. Pictures are premultiplied; an operation computes in linear light or on
/// sRGB-encoded values, as its primitive says.
#pragma once

#include <array>
#include <cstddef>
#include <variant>
#include <vector>

#include <vtm/scene/affine.hpp>
#include <vtm/scene/nested.hpp>
#include <vtm/scene/paint.hpp>

#pragma GCC visibility push(default)

namespace vtm::scene {

struct Group;
enum class BlendMode;

/// What an operation reads: the group that is filtered, its alpha (black), or the result of an earlier
/// primitive.
struct FilterInput {
    enum class Kind { SourceGraphic, SourceAlpha, Result } kind = Kind::SourceGraphic;
    std::size_t result = 0;  ///< index into Filter::primitives, below that of the reader
};

// ---- Operations, each with the number of inputs it must have -----------------------------------

/// The first input over the second, blended. Two inputs.
struct BlendFilter {
    BlendMode mode{};
};

/// Rows of (R G B A 1) to R, G, B, A; on straight colours. One input.
struct ColorMatrixFilter {
    std::array<float, 20> matrix{};
};

/// Of a straight channel c in [0, 1]; the result is clamped.
struct TransferFunction {
    enum class Kind {
        Table,     ///< values at c = 0, 1/n, …, 1, interpolated; empty: identity
        Discrete,  ///< value i for c in [i/n, (i+1)/n); empty: identity
        Linear,    ///< slope, intercept
        Gamma      ///< amplitude, exponent, offset
    } kind = Kind::Table;
    std::vector<float> values;
};
/// Red, green, blue, alpha. One input.
struct ComponentTransferFilter {
    std::array<TransferFunction, 4> functions;
};

/// Porter-Duff on premultiplied colours, or k1 i1 i2 + k2 i1 + k3 i2 + k4. Two inputs.
struct CompositeFilter {
    enum class Operator { Over, In, Out, Atop, Xor, Lighter, Arithmetic } op = Operator::Over;
    std::array<float, 4> k{};  ///< of Arithmetic
};

/// What lies beyond the border of an input.
enum class EdgeMode { Duplicate, Wrap, None };

/// One input. The kernel's entries lie a pixel of the raster apart.
struct ConvolveMatrixFilter {
    std::size_t columns = 3, rows = 3;  ///< at most maxKernel
    std::vector<float> kernel;          ///< columns · rows, as written: rotated by 180° against the picture
    float divisor = 1, bias = 0;        ///< divisor != 0
    std::size_t targetX = 1, targetY = 1;
    EdgeMode edge = EdgeMode::Duplicate;
    bool preserveAlpha = false;
};
inline constexpr std::size_t maxKernel = 1024;  ///< entries

struct DistantLight {
    float azimuth = 0, elevation = 0;  ///< degrees
};
struct PointLight {
    std::array<float, 3> position{};  ///< user space; z in units of its mean scale
};
struct SpotLight {
    std::array<float, 3> position{}, pointsAt{};
    float exponent = 1;
    float coneAngle = 180;  ///< degrees from the axis; 180: no cone
};
/// The input's alpha as a surface that is lit. One input.
struct LightingFilter {
    bool specular = false;  ///< else diffuse
    float surfaceScale = 1;
    float constant = 1;  ///< kd or ks, >= 0
    float exponent = 1;  ///< of specular light, in [1, 128]
    Color color{1, 1, 1, 1};
    std::variant<DistantLight, PointLight, SpotLight> light;
};

enum class Channel { R, G, B, A };
/// Moves the first input by the second. Two inputs. The second one's colours are read in the primitive's
/// colour space; the first one's are not converted.
struct DisplacementMapFilter {
    float scale = 0;  ///< user units
    Channel x = Channel::A, y = Channel::A;
};

/// The input over its alpha, moved, blurred and coloured. One input.
struct DropShadowFilter {
    float dx = 0, dy = 0, deviationX = 0, deviationY = 0;  ///< deviations >= 0
    Color color{0, 0, 0, 1};
};

/// No inputs.
struct FloodFilter {
    Color color{0, 0, 0, 1};
};

/// Standard deviations, >= 0; along an axis where it is 0 nothing is blurred. One input.
struct GaussianBlurFilter {
    float deviationX = 0, deviationY = 0;
};

/// A picture of its own, in the space of the scene: feImage, FillPaint, StrokePaint. No inputs.
struct PictureFilter {
    Link<Group> content;  ///< not null
};

/// Each input over those before it. Any number of inputs.
struct MergeFilter {};

/// Least or largest value of each channel within the radii. One input.
struct MorphologyFilter {
    float radiusX = 0, radiusY = 0;  ///< >= 0; if one is 0, nothing changes along it, if both are, at all
    bool dilate = false;
};

/// One input.
struct OffsetFilter {
    float dx = 0, dy = 0;
};

/// The input's subregion, repeated. One input.
struct TileFilter {};

/// Perlin's noise. No inputs.
struct TurbulenceFilter {
    float frequencyX = 0, frequencyY = 0;  ///< per user unit, >= 0
    int octaves = 1;                       ///< in [0, maxOctaves]
    int seed = 0;
    bool stitch = false, fractalNoise = false;
};
inline constexpr int maxOctaves = 24;

using FilterOperation =
    std::variant<BlendFilter, ColorMatrixFilter, ComponentTransferFilter, CompositeFilter,
                 ConvolveMatrixFilter, LightingFilter, DisplacementMapFilter, DropShadowFilter, FloodFilter,
                 GaussianBlurFilter, PictureFilter, MergeFilter, MorphologyFilter, OffsetFilter, TileFilter,
                 TurbulenceFilter>;

struct FilterPrimitive {
    FilterOperation operation;
    std::vector<FilterInput> inputs;
    Point min, max;      ///< the subregion, in user space; max >= min
    bool linear = true;  ///< computes in linear light (color-interpolation-filters)
};

/// The last primitive's result, cut to the region, replaces the group.
struct Filter {
    Affine transform = identity;              ///< user space to picture; must not flatten the plane
    Point min, max;                           ///< the filter region, in user space; max >= min
    std::vector<FilterPrimitive> primitives;  ///< 1 to maxPrimitives
};
inline constexpr std::size_t maxPrimitives = 4096;

}  // namespace vtm::scene

#pragma GCC visibility pop
