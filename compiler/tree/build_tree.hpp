/// \file
/// LoweredScene in, tree out: outlines are divided down a 16-tree until each leaf's planar map is small.
#pragma once

#include "compiler/tree/tree.hpp"

namespace vtm::compiler {

/// A map's tree, joined from the trees of blocks. Their pieces stay where they are.
struct JoinedTree {
    struct Block {
        std::vector<Tree::Piece> pieces;
        std::vector<PaintId> paints;  ///< of the joined palette, by those in `pieces`; empty: the same
    };
    Tree tree;                  ///< without pieces
    std::vector<Block> blocks;  ///< in walking order; leaves count pieces through all of them
};

/// Builds the tree over `root` for the given layers (ascending), on all processors; the result does not
/// depend on their number. Throws LimitError if the outlines are too tangled for the work limit.
JoinedTree buildTree(const LoweredScene& picture, const Square& root, std::span<const std::uint32_t> layers,
                     const Painter& painter, const TreeOptions& options, TreeTimes& times);

}  // namespace vtm::compiler
