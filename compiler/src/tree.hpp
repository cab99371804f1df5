/// \file
/// Cells and tree: chords are pushed down a 16-tree until each leaf's planar map is small.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "asset/asset.hpp"
#include "compiler/src/picture.hpp"

namespace vtm::compiler {

/// Where a node stands to a layer.
enum class Cover : std::uint8_t { Out, Edge, In };

/// What gives regions their paints, and tells which layers can be forgotten.
class Painter {
public:
    virtual ~Painter() = default;
    /// The paint where exactly the given layers are inside; `layers` are those that may be, ascending.
    virtual std::uint16_t paint(std::span<const std::uint32_t> layers,
                                const std::vector<std::uint8_t>& inside) = 0;
    /// Clears keep[i] for each of the ascending `layers` that cannot show, where cover(layer) says how
    /// it covers the cell.
    virtual void cull(std::span<const std::uint32_t> layers, const std::vector<Cover>& covers,
                      std::vector<std::uint8_t>& keep) = 0;
    /// Mean of paints, for a leaf that could not be proven.
    virtual std::uint16_t mean(std::span<const std::uint16_t> paints) = 0;
};

struct TreeOptions {
    double fitTolerance = 1;  ///< lattice steps
    unsigned piecesPerLeaf = 12;
    unsigned minDepth = 2;  ///< of leaves with pieces: keeps their quantisation below the tolerance
    unsigned maxDepth = 8;
};

/// Milliseconds spent in each part, added up.
struct TreeTimes {
    double push = 0, planarise = 0, fit = 0;
};

/// Builds the tree over `root` for the given layers (ascending) and appends its nodes, leaves and
/// pieces to `asset`. Throws LimitError if the outlines are too tangled for the work limit.
asset::Entry buildTree(const Picture& picture, const Square& root, std::span<const std::uint32_t> layers,
                       Painter& painter, const TreeOptions& options, asset::Asset& asset, TreeTimes& times);

}  // namespace vtm::compiler
