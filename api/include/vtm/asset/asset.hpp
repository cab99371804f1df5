/// \file
/// The Vector Texture Map as data: the compiler makes it, and every renderer samples it.
///
/// A *map* (the paper's VTM) is a 16-tree over a square of the picture. A leaf is solid, or holds
/// pieces: Hermite cubics over their chords, each with one region on its left and one on its right.
/// Maps may be placed in other maps: a picture that repeats a shape stores it once.
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

/// An entry of the tree. The low two bits hold the kind, the other bits the payload.
struct Entry {
    enum class Kind : std::uint32_t { Solid, Leaf, Node, Instances };
    std::uint32_t bits = 0;

    static Entry make(Kind kind, std::uint32_t payload) {
        return {(payload << 2) | static_cast<std::uint32_t>(kind)};
    }
    Kind kind() const { return static_cast<Kind>(bits & 3); }
    /// Solid: an index into Asset::paints. Leaf: into Asset::leaves. Node: into Asset::nodes. Instances: see
    /// InstanceTree.
    std::uint32_t payload() const { return bits >> 2; }
};

/// 4 x 4 children, row by row from the square's (min x, min y). Four texels. A child that is a node has a
/// larger index than its parent, so a tree cannot contain itself. Entries may share children.
struct Node {
    std::array<Entry, 16> children;
};

/// Max depth of a leaf below its map's root. The side of a leaf at level d is 4^-d of the map's side.
inline constexpr unsigned maxLevel = 12;

/// Max number of squares and pieces that the commands draw; each counts every time it is drawn.
inline constexpr std::uint64_t maxDrawn = 1u << 27;

/// Position of a square in its map: (x, y) counts squares of side 4^-level from the map's min corner.
struct Cell {
    std::uint32_t x = 0, y = 0;
    unsigned level = 0;
};

// ---- Leaves -----------------------------------------------------------------------------------

/// Leaf coordinates are in [0, leafExtent]; both ends lie exactly on the leaf's border.
inline constexpr std::uint32_t leafExtent = 65535;
/// A slope is its stored value / slopeScale, so slopes lie in [-1, 1] (a piece turns by at most 22.5
/// degrees).
inline constexpr float slopeScale = 32767;

/// Side of a leaf on which a piece's end point lies: side k runs from corner k to corner k + 1,
/// counter-clockwise from (min, min). Returns -1 for a point inside. A point on corner k belongs to side k,
/// so the corner's paint is the one on side k - 1, *before* a piece that begins there. The test uses the
/// stored integers.
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

/// The curve P(s) = A + s·(B - A) + t(s)·perp(B - A), s in [0, 1], perp(x, y) = (-y, x), t(s) = mA·s·(1-s)² -
/// mB·s²·(1-s): a cubic with end points A, B and slopes mA, mB over its chord (the paper's Hermite function,
/// its sign corrected). Going from A to B in a frame with x right and y *up*, `left` lies on the left; leaf
/// coordinates follow the picture (y down) and the rule is applied to the numbers as stored: left is the side
/// of +perp(B - A). One texel: x = A, y = B, z = slopes, w = left, right (low half first).
struct Piece {
    std::array<std::uint16_t, 2> a{}, b{};
    std::int16_t slopeA = 0, slopeB = 0;
    std::uint16_t left = 0, right = 0;
};

// ---- Instances --------------------------------------------------------------------------------

/// A map that is placed in other maps, with the paints that stand for its own. The paints that such a map
/// names are numbers of its own: 0 is its outside, which shows the ground, and i > 0 stands for
/// Asset::palettes[palette + i - 1]. These and the ground are paints of the map in which it is placed. Paints
/// are evaluated in the picture's space, wherever a map is placed. One texel.
struct Symbol {
    std::uint16_t map = 0;     ///< larger than the index of each map in which it is placed
    std::uint16_t ground = 0;  ///< the paint that lies around and below its regions
    std::uint32_t palette = 0;
    float scale = 0;  ///< of Instance::linear
    std::uint32_t unused = 0;
};

/// A symbol at a place of another map. A point c of the symbol's map is at centre + linear (c - 1/2); both
/// count sides of their map's square from its min corner. What is drawn is the map around it plus share ·
/// (paint - ground) for each of the symbol's regions: exact where the ground is what is drawn without the
/// symbol, or under it, and where regions of instances that do not lie in each other do not overlap.
/// One texel: x: centre x (24 bits), low byte of the symbol; y: centre y, high byte; z, w: first and second
/// column of `linear`, signed, in 1 / slopeScale of Symbol::scale.
struct Instance {
    Texel bits{};

    std::uint16_t symbol() const { return std::uint16_t((bits[0] >> 24) | (bits[1] >> 24) << 8); }
    /// In centreSteps of the square's side.
    std::array<std::uint32_t, 2> centre() const { return {bits[0] & 0xFFFFFFu, bits[1] & 0xFFFFFFu}; }
    /// m00, m01 (the image of x), m10, m11.
    std::array<std::int16_t, 4> linear() const {
        return {std::int16_t(bits[2] & 0xFFFFu), std::int16_t(bits[2] >> 16), std::int16_t(bits[3] & 0xFFFFu),
                std::int16_t(bits[3] >> 16)};
    }
    static Instance make(std::uint16_t symbol, std::array<std::uint32_t, 2> centre,
                         std::array<std::int16_t, 4> linear) {
        const auto pair = [](std::int16_t low, std::int16_t high) {
            return std::uint32_t(std::uint16_t(low)) | std::uint32_t(std::uint16_t(high)) << 16;
        };
        return {{centre[0] | std::uint32_t(symbol & 0xFFu) << 24,
                 centre[1] | std::uint32_t(symbol >> 8) << 24, pair(linear[0], linear[1]),
                 pair(linear[2], linear[3])}};
    }
};
inline constexpr double centreSteps = 1u << 24;

/// The instances of a map whose sizes are alike, in a 16-tree over the map's square. Its entries are Solid 0
/// (none), Node and Instances; the cell of an Instances entry holds the centres of its instances. One texel.
struct InstanceTree {
    Entry root;
    float reach = 0;         ///< no point of an instance is farther from its centre, along x or y; sides
    std::uint32_t next = 0;  ///< 0, or 1 + the index of the map's next tree, which is larger
    std::uint32_t unused = 0;
};

/// The payload of an Instances entry: Asset::instances[first] and those that follow it.
inline constexpr std::uint32_t maxInstancesPerCell = 64, maxInstances = 1u << 24;
struct InstanceRange {
    std::uint32_t first, count;

    explicit InstanceRange(Entry entry) : first(entry.payload() >> 6), count((entry.payload() & 63u) + 1) {}
    static Entry entry(std::uint32_t first, std::uint32_t count) {
        return Entry::make(Entry::Kind::Instances, first << 6 | (count - 1));
    }
};

/// Max number of maps in each other, the outermost one included.
inline constexpr unsigned maxMapDepth = 8;

// ---- Paints -----------------------------------------------------------------------------------

/// Alpha word of a paint that is a program.
inline constexpr std::uint32_t programTag = 0xFFFFFFFFu;

/// One texel. Solid: premultiplied sRGB floats as bits. Program: {first texel, number of
/// instructions, 0, programTag} in Asset::data. Paint 0 is transparent.
using Paint = Texel;
inline bool isProgram(const Paint& paint) { return paint[3] == programTag; }

/// A paint program runs on a stack of premultiplied colours that starts with one transparent entry; its
/// result is the single entry left at the end. It describes the stack of layers over one region, groups
/// included.
enum class Op : std::uint32_t {
    Push,              ///< push transparent: begin a group
    Pop,               ///< s = pop · opacity; top = blend(top, s)
    PopMaskLuminance,  ///< m = luminance of pop (premultiplied, sRGB bytes); top = top · m
    PopMaskLinear,     ///< the same in linear light
    PopMaskAlpha,      ///< m = alpha of pop; top = top · m
    Solid,             ///< s = data[argument] (premultiplied floats) · opacity; top = s over top
    Linear,            ///< s = gradient at data[argument] · opacity; top = s over top
    Radial,            ///< likewise
    Image,             ///< likewise
    Material           ///< likewise, with a material fill
};
inline constexpr unsigned maxStack = 8;
inline constexpr unsigned maxInstructions = 4096;  ///< in one program

/// Blend modes, in the order of scene::BlendMode.
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
    std::uint32_t argument = 0;  ///< index of a texel of Asset::data
};

enum class Spread : std::uint32_t { Pad, Reflect, Repeat };

/// Three texels, then `stopCount` GradientStop. (x, y) = matrix · (picture point, 1), columns (m0 m1), (m2
/// m3), (m4 m5). Linear: offset = x. Radial: the end circle is the unit circle, the focal circle has centre
/// (fx, fy) and radius fr. The offset is the larger root u of |p - (1-u) f| = (1-u) fr + u for which that
/// radius is not negative; the colour is transparent where no such root exists.
struct Gradient {
    std::array<float, 6> matrix{1, 0, 0, 1, 0, 0};
    Spread spread = Spread::Pad;
    std::uint32_t stopCount = 0;
    float fx = 0, fy = 0, fr = 0, unused = 0;
};
/// One texel: offset; red | green << 16 and blue | alpha << 16, straight 16-bit unorm; one unused word.
struct GradientStop {
    float offset = 0;
    std::array<std::uint16_t, 4> rgba{};
    std::uint32_t unused = 0;
};

/// How an image is sampled, in the order of scene::ImageFilter.
enum class ImageFilter : std::uint32_t {
    Nearest,
    Bilinear,
    Trilinear,  ///< means of squares as wide as the footprint's shorter axis, at points along its longer axis
    Bicubic     ///< the same, with the Catmull-Rom kernel in the full-size image
};

/// Two texels. `matrix` maps picture coordinates to pixels of Asset::images[image]. Beyond the image its
/// border pixels repeat.
struct ImageFill {
    std::array<float, 6> matrix{1, 0, 0, 1, 0, 0};
    std::uint32_t image = 0;
    ImageFilter filter = ImageFilter::Trilinear;
};

static_assert(sizeof(Node) == 64 && sizeof(Leaf) == 16 && sizeof(Piece) == 16);
static_assert(sizeof(Symbol) == 16 && sizeof(Instance) == 16 && sizeof(InstanceTree) == 16);
static_assert(sizeof(Instruction) == 16 && sizeof(Gradient) == 48 && sizeof(GradientStop) == 16);
/// Three texels. `matrix` maps picture coordinates to the space of Asset::materials[material].
struct MaterialFill {
    std::array<float, 6> matrix{1, 0, 0, 1, 0, 0};
    std::uint32_t material = 0;
    std::uint32_t unused = 0;
    std::array<float, 4> fallback{};  ///< premultiplied colour for engines that do not run GLSL
};

/// A procedural paint. `glsl` is GLSL ES 3.00 that defines `vec4 NAME(vec2 p)`: the premultiplied colour at
/// point p. A program that draws an untrusted asset runs this text, within the limits that GL sets for a
/// shader.
struct Material {
    std::string name;  ///< a letter, then letters, digits and single underscores; unique in the asset
    std::string glsl;  ///< without zero bytes

    bool operator==(const Material&) const = default;
};
inline constexpr std::size_t maxMaterials = 256, maxMaterialName = 64, maxMaterialText = 65536;

static_assert(sizeof(ImageFill) == 32 && sizeof(MaterialFill) == 48);

// ---- Filters ----------------------------------------------------------------------------------

/// What a primitive computes. Its parameters are floats in Asset::filterWords, in this order.
enum class FilterOp : std::uint32_t {
    Blend,              ///< blend mode
    ColorMatrix,        ///< 20 numbers, row by row
    ComponentTransfer,  ///< for red, green, blue, alpha: kind (TransferKind), number of values, values
    Composite,          ///< operator (CompositeOp), k1, k2, k3, k4
    ConvolveMatrix,     ///< columns, rows, target x, target y, divisor, bias, edge (FilterEdge), preserve
                        ///< alpha (0, 1), kernel
    Lighting,           ///< specular (0, 1), surface scale, constant, exponent, red, green, blue, kind of
                        ///< light (LightKind), position (3; distant: azimuth, elevation, 0), points at (3),
                        ///< spot's exponent, cone angle
    DisplacementMap,    ///< scale, channel of x, channel of y (0 to 3)
    DropShadow,         ///< dx, dy, deviation x, deviation y, straight red, green, blue, alpha
    Flood,              ///< straight red, green, blue, alpha
    GaussianBlur,       ///< deviation x, deviation y
    Picture,            ///< number of the picture among those that were pushed for the filter; 0: the group
    Merge,              ///< none
    Morphology,         ///< radius x, radius y, dilate (0, 1)
    Offset,             ///< dx, dy
    Tile,               ///< none
    Turbulence          ///< frequency x, frequency y, octaves, seed, stitch (0, 1), fractal noise (0, 1)
};
enum class TransferKind : std::uint32_t { Table, Discrete, Linear, Gamma };
enum class CompositeOp : std::uint32_t { Over, In, Out, Atop, Xor, Lighter, Arithmetic };
enum class FilterEdge : std::uint32_t { Duplicate, Wrap, None };
enum class LightKind : std::uint32_t { Distant, Point, Spot };

/// A step of a filter. vtm/scene/filter.hpp says what each operation means.
struct FilterPrimitive {
    FilterOp op = FilterOp::Merge;
    std::uint32_t linear = 0;  ///< 1: computes in linear light; 0: on sRGB-encoded values
    /// Of Asset::filterWords: first the inputs (0: the filtered picture, 1: its alpha, 2 + i: the result of
    /// the filter's primitive i), then the parameters.
    std::uint32_t firstWord = 0, inputs = 0, parameters = 0;
    std::uint32_t unused = 0;
    std::array<double, 4> region{};  ///< min x, min y, max x, max y of the subregion in the filter's space
};

/// A filter: `matrix` maps its user space to the picture.
struct Filter {
    std::array<double, 6> matrix{1, 0, 0, 1, 0, 0};
    std::array<double, 4> region{};  ///< min x, min y, max x, max y
    std::uint32_t firstPrimitive = 0, primitives = 0;
    std::uint32_t pictures = 1;  ///< that are pushed for it: what is filtered, then those of its operations
    std::uint32_t unused = 0;
};
inline constexpr std::size_t maxFilterPrimitives = 4096;  ///< of one filter
inline constexpr std::size_t maxKernel = 1024;            ///< entries of a convolution's kernel

static_assert(sizeof(FilterPrimitive) == 56 && sizeof(Filter) == 96);

// ---- Fonts ------------------------------------------------------------------------------------

/// An outline of a glyph: a part that touches no other, as the dot of an i. Glyphs share parts. One texel.
struct GlyphPart {
    std::uint32_t map = 0;  ///< lies in ems, y down; number 0 is outside, 1 inside
    float x = 0, y = 0;     ///< from the glyph's origin to that of the map, ems
    std::uint32_t unused = 0;
};

/// A glyph of the font that an asset holds. One texel.
struct Glyph {
    std::uint32_t id = 0;         ///< in the font
    std::uint32_t parts = 0;      ///< of Asset::glyphParts: the first, and 2^24 times their number
    float advance = 0;            ///< along a horizontal line, ems
    std::uint32_t character = 0;  ///< a character that it stands for; 0: none

    std::uint32_t firstPart() const { return parts & 0xFFFFFFu; }
    std::uint32_t partCount() const { return parts >> 24; }
};
inline constexpr std::size_t maxGlyphParts = 255;  ///< of one glyph

/// The font that an asset's glyphs are of (vtm/font/font_maps.hpp). One texel.
struct Font {
    std::uint64_t key = 0;          ///< differs where files, faces, variations or tolerances do
    float ascent = 0, descent = 0;  ///< above and below the baseline, ems, both positive as a rule
};

static_assert(sizeof(Glyph) == 16 && sizeof(GlyphPart) == 16 && sizeof(Font) == 16);

// ---- Whole ------------------------------------------------------------------------------------

/// Max magnitude of a map's position and of the picture's size; its inverse is the min side and size. Numbers
/// stay far from the limits of single precision under any view.
inline constexpr double largestLength = 0x1p40;

/// A tree over the square [x, x + side] × [y, y + side] of the picture (y down).
struct Map {
    double x = 0, y = 0, side = 0;
    Entry root;
    std::uint32_t instances = 0;  ///< 0, or 1 + the index of its first tree in Asset::instanceTrees
};

/// Max number of pictures on the stack of drawing commands, and max number of commands.
inline constexpr unsigned maxPictures = 64;
inline constexpr std::size_t maxCommands = 1u << 22;

/// One drawing command. Commands run on a stack of pictures that starts with one transparent picture and ends
/// with one picture.
struct Command {
    enum class Kind : std::uint32_t {
        DrawMap,   ///< top += map; its paint 0 is Asset::paints[paint], and so on
        FillMask,  ///< s = coverage(map) · paint; top = s over top. The map's paint indices
                   ///< are 0 outside and 1 inside
        Push,      ///< push a transparent picture
        Pop,       ///< s = pop · opacity; top = blend(top, s)
        PopMaskLuminance,
        PopMaskLinear,
        PopMaskAlpha,  ///< these three as in Op
        ClipMask,      ///< top = top · coverage(map)
        PushInput,  ///< push a transparent picture on the raster of a filter, whose index `map` is: first for
                    ///< what is filtered, then for each of the pictures of its operations
        Filter      ///< replaces them by one picture, the filter's result on the raster of the one below
    };
    Kind kind = Kind::DrawMap;
    Blend blend = Blend::Normal;
    float opacity = 1;
    std::uint32_t map = 0;  ///< or the index of a filter
    std::uint32_t paint = 0;
};
static_assert(sizeof(Map) == 32 && sizeof(Command) == 20);

enum class Mode : std::uint32_t {
    Exact,  ///< coverage-weighted mean of disjoint regions: one DrawMap, no seams. Where there are filters:
            ///< one for what lies below and above each, and within it; no FillMask, no ClipMask
    Compat  ///< layers composited with `over`, coverage as alpha, as other renderers do
};

struct Asset {
    double width = 0, height = 0;  ///< the picture's size, user units
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
    std::vector<InstanceTree> instanceTrees;
    std::vector<Instance> instances;
    std::vector<Symbol> symbols;
    std::vector<std::uint16_t> palettes;
    std::vector<Filter> filters;
    std::vector<FilterPrimitive> filterPrimitives;
    std::vector<std::uint32_t> filterWords;
    std::uint32_t fallbackLeaves = 0;  ///< leaves filled with a mean of samples, larger than the tolerance
    /// Where filters were drawn when the picture was compiled: so many pixels along its longer side; else 0.
    std::uint32_t filterPixels = 0;
    Prefilter prefilter;  ///< for minification; optional (vtm/raster/prefilter.hpp)
    /// How far the asset may be magnified: the side, in user units, of the smallest pixel for which every
    /// drawn boundary lies within a sixteenth of a pixel of the scene's. 0: any size. Empty if unknown, as in
    /// files written before the format stored it. Images and gradients have limits of their own.
    std::optional<double> finestPixel;
    /// Where maps are a font's glyphs; the commands then draw a specimen.
    std::optional<Font> font;
    std::vector<Glyph> glyphs;  ///< by ascending id
    std::vector<GlyphPart> glyphParts;
};

/// Max distance between drawn and true boundaries at finestPixel, in pixels.
inline constexpr double finestShare = 1.0 / 16;

/// Spans over an Asset, the form that every function reads. Owns nothing; valid while the arrays that it
/// points into live.
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
    std::span<const InstanceTree> instanceTrees;
    std::span<const Instance> instances;
    std::span<const Symbol> symbols;
    std::span<const std::uint16_t> palettes;
    std::span<const Filter> filters;
    std::span<const FilterPrimitive> filterPrimitives;
    std::span<const std::uint32_t> filterWords;
    std::uint32_t fallbackLeaves = 0;
    std::uint32_t filterPixels = 0;
    PrefilterView prefilter;
    std::optional<double> finestPixel;
    std::optional<Font> font;
    std::span<const Glyph> glyphs;
    std::span<const GlyphPart> glyphParts;

    AssetView() = default;
    AssetView(const Asset& asset);  // NOLINT(google-explicit-constructor): converts implicitly
};

/// Returns for each image whether a paint program reads its mip levels (a trilinear or bicubic fill).
std::vector<bool> imagesWithLevels(const AssetView& asset);

/// Returns whether the asset is a sum of maps and nothing else. In exact mode the compiler makes one map.
bool isSumOfMaps(const AssetView& asset);

/// Returns a copy that owns its records.
Asset toAsset(const AssetView& view);

/// Figures for `vtm info`.
struct Summary {
    std::size_t bytes = 0;  ///< all texels and images as uploaded, without the prefilter
    std::size_t prefilterBytes = 0;
    std::size_t leaves = 0;  ///< leaves with pieces
    std::size_t solids = 0;  ///< solid entries of the trees
    std::size_t pieces = 0;
    std::size_t regions = 0;  ///< distinct paints
    std::size_t instances = 0;
    std::size_t glyphs = 0;
    unsigned maxDepth = 0;
};
Summary summarize(const AssetView& asset);

}  // namespace vtm::asset

#pragma GCC visibility pop
