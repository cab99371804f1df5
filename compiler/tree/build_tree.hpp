/// \file
/// LoweredScene in, tree out: outlines are divided down a 16-tree until each leaf's planar map is small.
#pragma once

#include "compiler/tree/tree.hpp"

namespace vtm::compiler {

/// Builds the tree over `root` for the given layers (ascending), on all processors; the result does not
/// depend on their number. Throws LimitError if the outlines are too tangled for the work limit.
Tree buildTree(const LoweredScene& picture, const Square& root, std::span<const std::uint32_t> layers,
               const Painter& painter, const TreeOptions& options, TreeTimes& times);

}  // namespace vtm::compiler
