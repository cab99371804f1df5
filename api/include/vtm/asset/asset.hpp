/// \file
/// The Vector Texture Map as data: what the compiler makes and every renderer samples.
///
/// A *map* (the paper's VTM) is a 16-tree over a square of the picture. A leaf is solid, or holds
/// pieces: Hermite cubics over their chords, each with one region on its left and one on its right.
/// The records below are exactly what the container stores and what the shaders fetch, as RGBA32UI
/// texels in little-endian order; docs/asset_format.md explains every bit.
/// Source: Ray et al. 2005 (discontinuity map, 16-tree); our extension: any number of pieces and
/// regions in a leaf.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <vtm/asset/pyramid.hpp>
#include <vtm/image/bitmap.hpp>

#pragma GCC visibility push(default)

namespace vtm::asset {

/// One RGBA32UI texel.
using Texel = std::array<std::uint32_t, 4>;

// ---- Tree -------------------------------------------------------------------------------------

/// What stands at a place of the tree. The low two bits tell the kind, the rest is the payload.
struct Entry {
    enum class Kind : std::uint32_t { Solid, Leaf, Node };
    std::uint32_t bits = 0;

    static Entry make(Kind kind, std::uint32_t payload) {
        return {(payload << 2) | static_cast<std::uint32_t>(kind)};
    }
    Kind kind() const { return static_cast<Kind>(bits & 3); }
    /// Solid: a paint's index. Leaf, Node: an index into the leaves, the nodes.
    std::uint32_t payload() const { return bits >> 2; }
};

/// 4 x 4 children, row by row from the square's (min x, min y). Four texels. A child that is a node
/// has a larger index than its parent, so a tree cannot contain itself; places may share children.
struct Node {
    std::array<Entry, 16> children;
};

/// Depth of a leaf below its map's root: a leaf at level d spans 4^-d of the map's side.
inline constexpr unsigned maxLevel = 12;

/// Limit on all squares and pieces that the commands draw, each counted every time it is drawn.
inline constexpr std::uint64_t maxDrawn = 1u << 27;

/// Position of a square in its map: (x, y) counts squares of side 4^-level from the map's min corner.
struct Cell {
    std::uint32_t x = 0, y = 0;
    unsigned level = 0;
};

// ---- Leaves -----------------------------------------------------------------------------------

/// Leaf coordinates: 0 and `leafExtent` are the leaf's borders, exactly.
inline constexpr std::uint32_t leafExtent = 65535;
/// Stored slope / slopeScale = slope; so slopes lie in [-1, 1] (pieces turn by 22.5 degrees at most).
inline constexpr float slopeScale = 32767;

/// Side of a leaf on which a piece's end point lies: side k runs from corner k to corner k + 1,
/// counter-clockwise from (min, min); -1: inside. A point on corner k belongs to side k, so the
/// corner's paint is the one *before* what begins there, on side k - 1. Decided on the stored numbers.
constexpr int sideOf(const std::array<std::uint16_t, 2>& p) {
    if (p[1] == 0 && p[0] < leafExtent)
        return 0;
    if (p[0] == leafExtent && p[1] < leafExtent)
        return 1;
    if (p[1] == leafExtent && p[0] > 0)
        return 2;
    return p[0] == 0 && p[1] > 0 ? 3 : -1;
}

/// One texel: x = firstPiece, y = pieceCount | unused << 16, z = corners 0, 1, w = corners 2, 3
/// (low half first).
struct Leaf {
    std::uint32_t firstPiece = 0;
    std::uint16_t pieceCount = 0;
    std::uint16_t unused = 0;
    /// Paints at (min, min), (max, min), (max, max), (min, max) in leaf coordinates.
    std::array<std::uint16_t, 4> corners{};
};

/// The curve P(s) = A + s·(B - A) + t(s)·perp(B - A), s in [0, 1], perp(x, y) = (-y, x),
/// t(s) = mA·s·(1-s)² - mB·s²·(1-s): a cubic with end points A, B and slopes mA, mB over its chord
/// (the paper's Hermite function, its sign corrected). Going from A to B in a frame with x right and
/// y *up*, `left` lies on the left; leaf coordinates follow the picture (y down) and the rule is
/// applied to the numbers as they are: left is the side of +perp(B - A).
/// One texel: x = A, y = B, z = slopes, w = left, right (low half first).
struct Piece {
    std::array<std::uint16_t, 2> a{}, b{};
    std::int16_t slopeA = 0, slopeB = 0;
    std::uint16_t left = 0, right = 0;
};

// ---- Paints -----------------------------------------------------------------------------------

/// Alpha word of a paint that is a program.
inline constexpr std::uint32_t programTag = 0xFFFFFFFFu;

/// One texel. Solid: premultiplied sRGB floats as bits. Program: {first texel, number of
/// instructions, 0, programTag} in Asset::data. Paint 0 is transparent.
using Paint = Texel;
inline bool isProgram(const Paint& paint) { return paint[3] == programTag; }

/// A paint program runs on a stack of premultiplied colours that starts with one transparent entry;
/// its result is the one entry left at its end. It is the stack of layers over one region, groups and all.
enum class Op : std::uint32_t {
    Push,              ///< push transparent: begin a group
    Pop,               ///< s = pop · opacity; top = blend(top, s)
    PopMaskLuminance,  ///< m = luminance of pop (premultiplied, sRGB bytes); top = top · m
    PopMaskLinear,     ///< the same on linear light
    PopMaskAlpha,      ///< m = alpha of pop; top = top · m
    Solid,             ///< s = data[argument] (premultiplied floats) · opacity; top = s over top
    Linear,            ///< s = gradient at data[argument] · opacity; top = s over top
    Radial,            ///< likewise
    Image,             ///< likewise
    Material           ///< likewise, with a material fill
};
inline constexpr unsigned maxStack = 8;
inline constexpr unsigned maxInstructions = 4096;  ///< of one program

/// In the order of scene::BlendMode.
enum class Blend : std::uint32_t {
    Normal,
    Multiply,
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
    Hue,
    Saturation,
    Color,
    Luminosity,
    PlusLighter  ///< min(1, s + top)
};

/// One texel of a program.
struct Instruction {
    Op op = Op::Push;
    Blend blend = Blend::Normal;  ///< Pop only
    float opacity = 1;
    std::uint32_t argument = 0;  ///< a texel of Asset::data
};

enum class Spread : std::uint32_t { Pad, Reflect, Repeat };

/// Three texels, then `stopCount` GradientStop. (x, y) = matrix · (picture point, 1), columns
/// (m0 m1), (m2 m3), (m4 m5). Linear: offset = x. Radial: the end circle is the unit circle, the
/// focal circle has centre (fx, fy) and radius fr; the offset is the larger root u with
/// |p - (1-u) f| = (1-u) fr + u and non-negative radius; where there is none, transparent.
struct Gradient {
    std::array<float, 6> matrix{1, 0, 0, 1, 0, 0};
    Spread spread = Spread::Pad;
    std::uint32_t stopCount = 0;
    float fx = 0, fy = 0, fr = 0, unused = 0;
};
/// One texel: offset, red | green << 16, blue | alpha << 16 as 16-bit unorm, straight; unused.
struct GradientStop {
    float offset = 0;
    std::array<std::uint16_t, 4> rgba{};
    std::uint32_t unused = 0;
};

/// How an image is read; in the order of scene::ImageFilter.
enum class ImageFilter : std::uint32_t {
    Nearest,
    Bilinear,
    Trilinear,  ///< bilinear in the two levels of image/levels.hpp that are next to the footprint's shorter
                ///< axis, at points along the longer one
    Bicubic     ///< likewise, with Catmull-Rom's kernel in the image itself
};

/// Two texels. matrix: picture to pixels of Asset::images[image]; beyond its border the border's go on.
struct ImageFill {
    std::array<float, 6> matrix{1, 0, 0, 1, 0, 0};
    std::uint32_t image = 0;
    ImageFilter filter = ImageFilter::Trilinear;
};

static_assert(sizeof(Node) == 64 && sizeof(Leaf) == 16 && sizeof(Piece) == 16);
static_assert(sizeof(Instruction) == 16 && sizeof(Gradient) == 48 && sizeof(GradientStop) == 16);
/// Three texels. matrix: picture to the space of Asset::materials[material].
struct MaterialFill {
    std::array<float, 6> matrix{1, 0, 0, 1, 0, 0};
    std::uint32_t material = 0;
    std::uint32_t unused = 0;
    std::array<float, 4> fallback{};  ///< premultiplied, where no GLSL runs
};

/// A procedural paint. `glsl` is GLSL ES 3.00 that defines `vec4 NAME(vec2 p)`: the premultiplied colour at
/// point p. Whoever draws an asset from elsewhere runs its text, in the bounds that GL sets to a shader.
struct Material {
    std::string name;  ///< a letter, then letters, digits and single underscores; distinct
    std::string glsl;  ///< without zero bytes
};
inline constexpr std::size_t maxMaterials = 256, maxMaterialName = 64, maxMaterialText = 65536;

static_assert(sizeof(ImageFill) == 32 && sizeof(MaterialFill) == 48);

// ---- Whole ------------------------------------------------------------------------------------

/// Largest magnitude of a map's place and of the picture's size, and the inverse of the smallest side
/// and size: numbers stay far from the ends of single precision under any view.
inline constexpr double largestLength = 0x1p40;

/// A tree over the square [x, x + side] × [y, y + side] of the picture (y down).
struct Map {
    double x = 0, y = 0, side = 0;
    Entry root;
    std::uint32_t unused = 0;
};

/// Pictures on the stack of drawing commands, and commands, at most.
inline constexpr unsigned maxPictures = 64;
inline constexpr std::size_t maxCommands = 1u << 22;

/// One step of drawing, on a stack of pictures that starts with one transparent one and ends with one.
struct Command {
    enum class Kind : std::uint32_t {
        DrawMap,   ///< the picture += the map; its paints are Asset::paints. In exact mode, and nothing else
                   ///< there
        FillMask,  ///< s = coverage(map) · paint; top = s over top. The map's paint indices
                   ///< are 0 outside and 1 inside
        Push,      ///< push a transparent picture
        Pop,       ///< s = pop · opacity; top = blend(top, s)
        PopMaskLuminance,
        PopMaskLinear,
        PopMaskAlpha,  ///< as Op
        ClipMask       ///< top = top · coverage(map)
    };
    Kind kind = Kind::DrawMap;
    Blend blend = Blend::Normal;
    float opacity = 1;
    std::uint32_t map = 0;
    std::uint32_t paint = 0;
};
static_assert(sizeof(Map) == 32 && sizeof(Command) == 20);

enum class Mode : std::uint32_t {
    Exact,  ///< coverage-weighted mean of disjoint regions: one DrawMap, no seams
    Compat  ///< layer by layer `over`, coverage as alpha, as other renderers do
};

struct Asset {
    double width = 0, height = 0;  ///< the picture, user units
    Mode mode = Mode::Exact;
    std::vector<Map> maps;
    std::vector<Command> commands;
    std::vector<Node> nodes;
    std::vector<Leaf> leaves;
    std::vector<Piece> pieces;
    std::vector<Paint> paints;
    std::vector<Texel> data;  ///< programs, gradients, image and material fills
    std::vector<image::Bitmap> images;
    std::vector<Material> materials;
    std::uint32_t fallbackLeaves = 0;  ///< averaged from samples and too large for the tolerance
    Prefilter prefilter;               ///< for minification, optional (vtm/raster/prefilter.hpp)
    /// How far it may be magnified: the side, in user units, of the smallest pixels for which no drawn
    /// boundary lies farther than a sixteenth of one from the scene's. 0: of any size. Nothing where it is
    /// unknown, as in files that were written before it was stored. Images and gradients have limits of their
    /// own.
    std::optional<double> finestPixel;
};

/// What finestPixel promises, in pixels.
inline constexpr double finestShare = 1.0 / 16;

/// The same, as what every function reads: spans over an Asset. Valid as long as what they point into.
struct AssetView {
    double width = 0, height = 0;
    Mode mode = Mode::Exact;
    std::span<const Map> maps;
    std::span<const Command> commands;
    std::span<const Node> nodes;
    std::span<const Leaf> leaves;
    std::span<const Piece> pieces;
    std::span<const Paint> paints;
    std::span<const Texel> data;
    std::span<const image::Bitmap> images;
    std::span<const Material> materials;
    std::uint32_t fallbackLeaves = 0;
    PrefilterView prefilter;
    std::optional<double> finestPixel;

    AssetView() = default;
    AssetView(const Asset& a)  // NOLINT(google-explicit-constructor): an asset is passed as it is
        : width(a.width),
          height(a.height),
          mode(a.mode),
          maps(a.maps),
          commands(a.commands),
          nodes(a.nodes),
          leaves(a.leaves),
          pieces(a.pieces),
          paints(a.paints),
          data(a.data),
          images(a.images),
          materials(a.materials),
          fallbackLeaves(a.fallbackLeaves),
          prefilter{a.prefilter.size, a.prefilter.texels},
          finestPixel(a.finestPixel) {}
};

/// For each image, whether a paint program reads its levels: fills it trilinear or bicubic.
std::vector<bool> imagesWithLevels(const AssetView& asset);

/// Whether an asset is nothing but maps that are added up: what the compiler makes in exact mode, one map.
bool isSumOfMaps(const AssetView& asset);

/// A copy that owns its records.
Asset toAsset(const AssetView& view);

/// Figures for `vtm info`.
struct Summary {
    std::size_t bytes = 0;  ///< all texels and images, as uploaded, without the prefilter
    std::size_t prefilterBytes = 0;
    std::size_t leaves = 0;  ///< with pieces
    std::size_t solids = 0;  ///< solid entries of the trees
    std::size_t pieces = 0;
    std::size_t regions = 0;  ///< distinct paints
    unsigned maxDepth = 0;
};
Summary summarize(const AssetView& asset);

}  // namespace vtm::asset

#pragma GCC visibility pop
