/// \file
/// Paper-mode assets as texels behind a palette's data.
#pragma once

#include "paper/model.hpp"

namespace vtm::paper {

/// First texels, from the start of the data.
struct Sections {
    std::uint32_t masks = 0, nodes = 0;
};

/// Stands for the mask of a node with bounds.
inline constexpr std::uint32_t hasBounds = noIndex - 1;

/// Appends everything but the palette to `data`:
/// - a mask, two texels: x, y, side (floats), root; first texels of its tree, cells, mip; mip's log2 size;
/// - a node, two texels: mask, opacity (float), paint and rest inside; its bounds, paint and rest outside.
/// Paint
///   noIndex: discard. Mask hasBounds: the corners of the bounds count instead of a mask (x, y, 16 bits
///   each);
/// - a tree's node: 16 entries in four texels, as asset::Node;
/// - a cell, two texels, a piece each: A, B, slopes (16 bits each, low half first); of the first one, 0 for
///   one piece, otherwise 1 plus the operator;
/// - a mip: 16 bytes a texel, low byte first.
Sections appendTexels(const Asset& asset, std::vector<asset::Texel>& data);

}  // namespace vtm::paper
