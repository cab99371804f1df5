/// \file
/// Scene in, the paper's Vector Texture Map out (paper/model.hpp, docs/paper.md): a mask an item, a node
/// a mask, painter's order folded as T_i = (mask_i, paint_i over T_{i-1}, T_{i-1}).
#pragma once

#include <string>
#include <vector>

#include <vtm/compiler/compile.hpp>
#include <vtm/scene/scene.hpp>
#include "paper/model.hpp"

namespace vtm::paper {

struct CompileOptions {
    /// How far a piece may be off, as a share of the picture's longer side, but where three steps of its
    /// cell's coordinates are more; never more than 2^-14 of its mask. In [2^-26, 2^-6].
    double tolerance = 1.0 / 65536;
    /// Levels of the 16-tree of a mask. The paper has 2. In [0, 8].
    unsigned maxDepth = 5;
    /// The mip of a mask begins with 2^mipLog2 texels a side. In [0, 10].
    unsigned mipLog2 = 6;
    /// Composes sequences of items as balanced trees, so that a pixel visits the nodes near it only. Without,
    /// as in the paper, it visits all of them. Both draw the same picture.
    bool balanced = true;
};

/// Cells of all masks, and masks, beyond these numbers are a compiler::LimitError.
inline constexpr std::size_t maxCells = 4'000'000, maxMasks = 100'000;

struct CompileResult {
    Asset asset;
    CompileOptions options;
    /// The mask of each item, in painter's order (groups in depth); noIndex: it covers the picture and needs
    /// none.
    std::vector<std::uint32_t> maskOfItem;
    /// Nodes with bounds, and the masks, [first, end), that these hold.
    struct BoundedNode {
        std::uint32_t node = 0, firstMask = 0, endMask = 0;
    };
    std::vector<BoundedNode> bounded;
    /// By mask: cells of the last level that would need more than two pieces and one operator.
    std::vector<std::size_t> approximated;
    std::vector<compiler::StageTime> stages;  ///< "masks"
    std::vector<std::string> warnings;        ///< what the paper's model cannot say, and what was done
    std::size_t approximatedCells() const;
};

/// Clips and opacity of groups are nodes as well: a clip is a mask between two sides, a group's opacity
/// a node without a mask. Blend modes other than normal, masks by luminance or alpha,
/// filters and pattern paints cannot be said: such groups are drawn as if they had none, such items not at
/// all, with a warning. Throws scene::InvalidScene, compiler::LimitError, std::invalid_argument (options out
/// of range).
CompileResult compile(const scene::Scene& scene, const CompileOptions& options = {});

/// Row 16: remakes the mask of an item whose path, transform, fill rule or stroke changed, and
/// touches nothing else. `item` counts in painter's order. Throws std::out_of_range, compiler::LimitError,
/// std::invalid_argument where it covered the picture and has no mask.
void rebuildMask(CompileResult& result, std::size_t item, const scene::Item& changed);

}  // namespace vtm::paper
