/// \file
/// The Vector Texture Map as the paper has it, for comparison beside our default (docs/paper.md).
///
/// A *mask* is a 16-tree (row 8) of strict cells: at most two Hermite functions (row 1) and one operator
/// (row 2). A *node* is a VTM of VTMs (row 5): a mask and two sides, each a paint over another node.
/// Nothing is specialised: every pixel walks the nodes from the root down.
/// Source: Ray, Neiger, Lévy, Cavin 2005, with the errors of its text corrected.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <vtm/asset/asset.hpp>
#include <vtm/image/bitmap.hpp>
#include <vtm/raster/view.hpp>

namespace vtm::asset {

// ---- Cells --------------------------------------------------------------------------------------

/// A cell describes the boundary this share of its side beyond its borders too, so that a pixel beside
/// the border sees a curve that passes just outside. Cell coordinates: (0, 0) to (1, 1) is the cell
/// with that margin.
inline constexpr double paperMargin = 1.0 / 8;

/// Stored coordinate / paperExtent is a cell coordinate in [0, 1]. Divisible by 80, so that the places
/// 1/16, 1/4, 1/2, ... of a cell are met exactly in spite of the margin.
inline constexpr double paperExtent = 65520;
/// Stored slope / paperSlopeScale is a slope in [-5, 5], the paper's range; 16 bits, since 8 bend a
/// chord by up to 0.3 % of its length.
inline constexpr double paperSlopeScale = 32767.0 / 5;

/// The implicit function f(p) = v - t(u) in the local basis of A: p = A + u (B - A) + v perp(B - A),
/// perp(x, y) = (-y, x), with t(u) = mA u (1-u)² - mB u² (1-u) for u in [0, 1] and its end tangents
/// beyond. Inside where f > 0: left of A to B for y up.
struct PaperPiece {
    std::array<std::uint16_t, 2> a{}, b{};  ///< at most paperExtent
    std::int16_t slopeA = 0, slopeB = 0;
};

struct PaperValue {
    double value = 0;
    glm::dvec2 gradient{0};
};
/// f and ∇f at a point in cell coordinates. A and B must differ.
PaperValue implicitValue(const PaperPiece& piece, glm::dvec2 point);

/// The same piece with inside and outside exchanged.
PaperPiece reversed(const PaperPiece& piece);

enum class PaperOperator : std::uint8_t { Intersection, Union };

struct PaperCell {
    std::array<PaperPiece, 2> pieces;
    std::uint8_t count = 1;  ///< 1 or 2
    PaperOperator combine = PaperOperator::Intersection;
};

/// Signed distance to the cell's boundary, positive *outside*, in the units to which `toPixels` maps
/// cell coordinates: to first order h = d·n, d = -f ∇f / |∇f|², n = ∇f / |∇f|. Of two pieces the
/// intersection is max(h1, h2), the union -max(-h1, -h2).
double signedDistance(const PaperCell& cell, glm::dvec2 point, const glm::dmat2& toPixels);

/// Pixels 2^64 texels wide and more: a mask has faded to nothing in single precision.
inline constexpr double paperLargestLod = 64;

// ---- Masks --------------------------------------------------------------------------------------

/// The mip of the classification function (row 7): shares of texels inside, 255 is 1. Levels of
/// 2^sizeLog2, ..., 2, 1 texels a side one after the other, row by row.
struct PaperMip {
    unsigned sizeLog2 = 0;
    std::vector<std::uint8_t> texels;
};

/// A binary shape on the square [x, x + side] × [y, y + side] of the picture; outside it is 0.
struct PaperMask {
    double x = 0, y = 0, side = 1;
    Entry root;               ///< Solid: payload 0 or 1; Leaf: index of a cell; Node: of a node
    std::vector<Node> nodes;  ///< as asset::Node: children after their parents
    std::vector<PaperCell> cells;
    PaperMip mip;
};

// ---- Nodes --------------------------------------------------------------------------------------

inline constexpr std::uint32_t noPaperIndex = 0xFFFFFFFFu;

/// A paint over what a further node shows.
struct PaperSide {
    std::uint32_t paint = 0;            ///< of the palette; 0 is transparent
    std::uint32_t rest = noPaperIndex;  ///< a node with a smaller index, or nothing
    /// In place of paint and rest: the fragment is not written (row 14). Where it takes only part of a
    /// pixel it counts as transparent.
    bool discard = false;
    friend bool operator==(const PaperSide&, const PaperSide&) = default;
};

/// b·inside + (1 - b)·outside (row 4), b = opacity · coverage of the mask.
struct PaperNode {
    std::uint32_t mask = noPaperIndex;  ///< none: coverage 1
    float opacity = 1;                  ///< in [0, 1]
    PaperSide inside, outside;
};

/// Nodes that wait while a pixel is computed, at most: a shader's array is of fixed size. Painter's
/// order needs one, each clip or group around it one more.
inline constexpr unsigned maxPaperPending = 16;

struct PaperAsset {
    double width = 0, height = 0;  ///< the picture, user units
    std::vector<PaperMask> masks;
    std::vector<PaperNode> nodes;
    std::uint32_t root = noPaperIndex;  ///< none: nothing is drawn
    Asset palette;                      ///< its paints, data and images; nothing else of it
};

/// Throws FormatError (vtm/asset/container.hpp) unless every index, order and limit above holds.
void validate(const PaperAsset& asset);

// ---- Evaluation ---------------------------------------------------------------------------------

/// What a lookup touched (row 10).
struct PaperCost {
    std::uint64_t nodes = 0, masks = 0, indirections = 0, cells = 0, mips = 0, paints = 0;
    PaperCost& operator+=(const PaperCost& other);
};

/// A pixel's size and shape under a view.
struct PaperFootprint {
    glm::dmat2 toPixels;  ///< the view's linear part; its determinant must not be 0
    double longer;        ///< the longer of the pixel's axes in picture units
    explicit PaperFootprint(const glm::dmat2& toPixels);
};

/// Coverage of a mask by the pixel around a picture point.
double maskCoverage(const PaperMask& mask, glm::dvec2 point, const PaperFootprint& pixel, PaperCost& cost);

/// Whether a picture point is inside; on or beyond the square's border it is not.
bool classify(const PaperMask& mask, glm::dvec2 point);

struct PaperSample {
    glm::vec4 color{0};  ///< premultiplied
    bool discarded = false;
    PaperCost cost;
};
/// One fragment: the recursion walked at a picture point.
PaperSample sample(const PaperAsset& asset, glm::dvec2 point, const PaperFootprint& pixel);

/// Draws on transparent black, a sample a pixel, times the coverage of the picture's rectangle (by the
/// distance to its nearest side); adds what it cost to `cost` if there is one. `asset`
/// must be valid. Throws std::length_error if the view is beyond its limits.
image::Raster evaluate(const PaperAsset& asset, const View& view, PaperCost* cost = nullptr);

/// Figures for the command and the benches.
struct PaperSummary {
    std::size_t bytes = 0;     ///< masks and nodes as uploaded, mips included, palette not
    std::size_t mipBytes = 0;  ///< of these
    std::size_t gridBytes =
        0;  ///< what flat grids of each mask's finest cells would take in place of its tree
    std::size_t treeBytes = 0;  ///< what the trees with their cells take
    std::size_t masks = 0, nodes = 0, cells = 0, pieces = 0, indirections = 0;
};
PaperSummary summarize(const PaperAsset& asset);

}  // namespace vtm::asset
