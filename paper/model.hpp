/// \file
/// The Vector Texture Map as published in 2005, for comparison beside our default (docs/paper.md).
///
/// A *mask* is a 16-tree (row 8) of strict cells: at most two Hermite functions (row 1) and one operator
/// (row 2). A *node* is a VTM of VTMs (row 5): a mask and two sides, each a paint over another node.
/// Nothing is specialised: every pixel walks the nodes from the root down.
/// Source: Ray, Neiger, Lévy, Cavin 2005, with the errors of its text corrected.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <vtm/asset/asset.hpp>

namespace vtm::paper {

// ---- Cells --------------------------------------------------------------------------------------

/// A cell describes the boundary this share of its side beyond its borders too, so that a pixel beside
/// the border sees a curve that passes just outside. Cell coordinates: (0, 0) to (1, 1) is the cell
/// with that margin.
inline constexpr double cellMargin = 1.0 / 8;

/// Stored coordinate / cellExtent is a cell coordinate in [0, 1]. Divisible by 80, so that the places
/// 1/16, 1/4, 1/2, ... of a cell are met exactly in spite of the margin.
inline constexpr double cellExtent = 65520;
/// Stored slope / slopeScale is a slope in [-5, 5], the paper's range; 16 bits, since 8 bend a
/// chord by up to 0.3 % of its length.
inline constexpr double slopeScale = 32767.0 / 5;

/// The implicit function f(p) = v - t(u) in the local basis of A: p = A + u (B - A) + v perp(B - A),
/// perp(x, y) = (-y, x), with t(u) = mA u (1-u)² - mB u² (1-u) for u in [0, 1] and its end tangents
/// beyond. Inside where f > 0: left of A to B for y up.
struct Piece {
    std::array<std::uint16_t, 2> a{}, b{};  ///< at most cellExtent
    std::int16_t slopeA = 0, slopeB = 0;
};

enum class Operator : std::uint8_t { Intersection, Union };

struct Cell {
    std::array<Piece, 2> pieces;
    std::uint8_t count = 1;  ///< 1 or 2
    Operator combine = Operator::Intersection;
};

// ---- Masks --------------------------------------------------------------------------------------

/// The mip of the classification function (row 7): shares of texels inside, 255 is 1. Levels of
/// 2^sizeLog2, ..., 2, 1 texels a side one after the other, row by row.
struct Mip {
    unsigned sizeLog2 = 0;
    std::vector<std::uint8_t> texels;
};

/// A binary shape on the square [x, x + side] × [y, y + side] of the picture; outside it is 0.
struct Mask {
    double x = 0, y = 0, side = 1;
    asset::Entry root;               ///< Solid: payload 0 or 1; Leaf: index of a cell; Node: of a node
    std::vector<asset::Node> nodes;  ///< children after their parents
    std::vector<Cell> cells;
    Mip mip;
};

// ---- Nodes --------------------------------------------------------------------------------------

inline constexpr std::uint32_t noIndex = 0xFFFFFFFFu;

/// A paint over what a further node shows.
struct Side {
    std::uint32_t paint = 0;       ///< of the palette; 0 is transparent
    std::uint32_t rest = noIndex;  ///< a node with a smaller index, or nothing
    /// In place of paint and rest: the fragment is not written (row 14). Where it takes only part of a
    /// pixel it counts as transparent.
    bool discard = false;
    friend bool operator==(const Side&, const Side&) = default;
};

/// A rectangle of the picture, in 65535ths of its width and of its height.
struct Bounds {
    std::array<std::uint16_t, 2> min{0, 0}, max{0xFFFF, 0xFFFF};
    friend bool operator==(const Bounds&, const Bounds&) = default;
};

/// b·inside + (1 - b)·outside (row 4), b = opacity · coverage of the mask.
struct Node {
    std::uint32_t mask = noIndex;  ///< none: coverage 1
    float opacity = 1;             ///< in [0, 1]
    Side inside, outside;
    /// Instead of mask and opacity: b is 1 where a mask within these bounds may cover some of a pixel, else
    /// 0. So a pixel steps over a whole sequence of nodes that lies elsewhere.
    std::optional<Bounds> bounds = std::nullopt;
};

/// The most nodes that wait while a pixel is computed: a shader's array is of fixed size. Painter's
/// order needs one, each clip or group around it one more.
inline constexpr unsigned maxPending = 16;

struct Asset {
    double width = 0, height = 0;  ///< the picture, user units
    std::vector<Mask> masks;
    std::vector<Node> nodes;
    std::uint32_t root = noIndex;  ///< none: nothing is drawn
    asset::Asset palette;          ///< its paints, data and images; nothing else of it
};

/// Throws asset::FormatError (vtm/asset/container.hpp) unless every index, order and limit above holds.
void validate(const Asset& asset);

/// Figures for the command and the benches.
struct Summary {
    std::size_t bytes = 0;     ///< masks and nodes as uploaded, mips included, palette not
    std::size_t mipBytes = 0;  ///< of these
    std::size_t gridBytes =
        0;  ///< what flat grids of each mask's finest cells would take in place of its tree
    std::size_t treeBytes = 0;  ///< what the trees with their cells take
    std::size_t masks = 0, nodes = 0, cells = 0, pieces = 0, indirections = 0;
};
Summary summarize(const Asset& asset);

}  // namespace vtm::paper
