/// \file
/// The picture in blocks that are kept from one edit to the next, and joined to an asset's one map.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "compiler/session/changes.hpp"
#include "compiler/tree/block.hpp"

namespace vtm::compiler {

/// Blocks of this level are not split.
inline constexpr unsigned maxBlockLevel = 3;

/// A 16-tree of blocks. Each keeps all that passes through its square, hidden or not, so that edits need to
/// touch only the blocks that they concern; and the subtree that was built of it.
class Partition {
public:
    struct Block {
        Cell cell;  ///< not culled
        Tree tree;
        std::vector<PaintId> paints;  ///< the tree's, each once
        bool dirty = true;            ///< the tree is not that of the cell
        /// Where the tree is in the asset: its root, and its first node, leaf and piece.
        struct Place {
            asset::Entry root;
            std::uint32_t node = 0, leaf = 0, piece = 0;
        };
        std::optional<Place> place;  ///< nothing if it was built since the asset was, or is solid
    };
    /// The tree above the blocks.
    struct Top {
        std::optional<std::size_t> block;
        std::vector<Top> children;  ///< 16 if it is not a block
    };

    /// Nothing in one block; blocks will have `maximum` clipped runs at most where they can be split.
    /// `maximum`: clipped runs of a block that is not of the last level. No block is deeper than `maxDepth`.
    Partition(const Square& root, std::size_t maximum, unsigned maxDepth);

    /// Takes layers out and in, and marks the blocks that they or the layers `touched` (indices now) pass
    /// through. Blocks that have grown too large are split. `before`: the layers before, whose outlines are
    /// in the picture's store.
    void update(const std::vector<Layer>& before, const LoweredScene& picture, const LayerChanges& changes,
                const std::vector<std::uint32_t>& touched, Painter& painter);

    std::size_t maximum() const { return maximum_; }
    const Top& top() const { return top_; }
    std::vector<Block>& blocks() { return blocks_; }
    const std::vector<Block>& blocks() const { return blocks_; }

private:
    void mark(const Outlines& outlines, const std::vector<Layer>& layers,
              const std::vector<std::uint32_t>& which);
    void renumber(const LayerChanges& changes);
    void insert(Points points, Top& top, Cell& cell);
    void splitLarge(Points points, Culler& culler, Top& top);

    Square root_;
    std::size_t maximum_;
    unsigned deepest_;
    Top top_;
    std::vector<Block> blocks_;
};

/// Appends the blocks' trees to `next`: nodes, leaves, pieces and count of fallback leaves; `paints`: its
/// index of each paint. `last`: the asset that was joined before, if paints have the same indices there: the
/// blocks that were not built since are copied from it. Returns the root.
asset::Entry joinBlocks(Partition& partition, std::span<const std::uint16_t> paints, const asset::Asset* last,
                        asset::Asset& next);

}  // namespace vtm::compiler
