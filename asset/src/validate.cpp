#include "asset/src/validate.hpp"

#include <algorithm>

namespace vtm::asset {

namespace {

/// What a tree below an entry amounts to. Found for leaves, then for nodes from the last to the first,
/// since children have larger indices: every node is looked at once, however often it is shared.
struct Extent {
    std::uint64_t drawn = 1;  ///< squares and pieces; saturates above maxDrawn
    std::uint32_t depth = 0;
    std::uint32_t largestPaint = 0;

    void include(const Extent& child) {
        drawn = std::min(drawn + child.drawn, maxDrawn + 1);
        depth = std::max(depth, child.depth + 1);
        largestPaint = std::max(largestPaint, child.largestPaint);
    }
};

class Trees {
public:
    explicit Trees(const AssetView& asset) : asset_(asset) {
        for (std::size_t i = 0; i < asset.leaves.size(); ++i)
            leaves_.push_back(leafExtentOf(i));
        nodes_.resize(asset.nodes.size());
        for (std::size_t i = asset.nodes.size(); i-- > 0;)
            for (const Entry child : asset.nodes[i].children) {
                require(child.kind() != Entry::Kind::Node || child.payload() > i, "nodes", i,
                        "a child's index is not larger than its parent's");
                nodes_[i].include(extentOf(child, "nodes", i));
            }
    }

    Extent extentOf(Entry entry, const char* section, std::size_t index) const {
        switch (entry.kind()) {
            case Entry::Kind::Solid:
                require(entry.payload() < asset_.paints.size(), section, index,
                        "entry refers to a missing paint");
                return {1, 0, entry.payload()};
            case Entry::Kind::Leaf:
                require(entry.payload() < leaves_.size(), section, index, "entry refers to a missing leaf");
                return leaves_[entry.payload()];
            case Entry::Kind::Node:
                require(entry.payload() < nodes_.size(), section, index, "entry refers to a missing node");
                return nodes_[entry.payload()];
        }
        throw FormatError(fmt::format("{}[{}]: entry's kind is unknown", section, index));
    }

private:
    Extent leafExtentOf(std::size_t i) const {
        const Leaf& leaf = asset_.leaves[i];
        require(leaf.unused == 0, "leaves", i, "unused half is not zero");
        require(leaf.firstPiece <= asset_.pieces.size() &&
                    leaf.pieceCount <= asset_.pieces.size() - leaf.firstPiece,
                "leaves", i, "piece range is out of bounds");
        Extent extent{1u + leaf.pieceCount, 0, *std::ranges::max_element(leaf.corners)};
        for (std::size_t p = leaf.firstPiece; p < std::size_t(leaf.firstPiece) + leaf.pieceCount; ++p)
            extent.largestPaint =
                std::max<std::uint32_t>({extent.largestPaint, asset_.pieces[p].left, asset_.pieces[p].right});
        require(extent.largestPaint < asset_.paints.size(), "leaves", i,
                "a corner or piece refers to a missing paint");
        return extent;
    }

    const AssetView& asset_;
    std::vector<Extent> leaves_, nodes_;
};

void validatePieces(const AssetView& asset) {
    for (std::size_t i = 0; i < asset.pieces.size(); ++i)
        require(asset.pieces[i].slopeA >= -slopeScale && asset.pieces[i].slopeB >= -slopeScale, "pieces", i,
                "slope is below -1");
}

bool isLength(double value) { return value >= 1 / largestLength && value <= largestLength; }

void validateMap(const AssetView& asset, std::size_t i) {
    const Map& map = asset.maps[i];
    require(std::abs(map.x) <= largestLength && std::abs(map.y) <= largestLength && isLength(map.side),
            "maps", i, "square is out of range");
    require(map.unused == 0, "maps", i, "unused word is not zero");
}

bool drawsMap(Command::Kind kind) {
    return kind == Command::Kind::DrawMap || kind == Command::Kind::FillMask ||
           kind == Command::Kind::ClipMask;
}

/// Depth of the stack of pictures after a command.
unsigned depthAfter(const Command& command, unsigned depth, std::size_t i) {
    if (command.kind == Command::Kind::Push) {
        require(depth < maxPictures, "commands", i, "stack of pictures overflows");
        return depth + 1;
    }
    if (drawsMap(command.kind))
        return depth;
    require(depth > 1, "commands", i, "pops the last picture");
    return depth - 1;
}

void validateCommand(const AssetView& asset, const std::vector<Extent>& maps, std::size_t i) {
    const Command& command = asset.commands[i];
    require(command.kind <= Command::Kind::ClipMask, "commands", i, "kind is unknown");
    require(command.blend <= Blend::PlusLighter, "commands", i, "blend mode is unknown");
    require(isShare(command.opacity), "commands", i, "opacity is out of range");
    require(!drawsMap(command.kind) || command.map < maps.size(), "commands", i, "refers to a missing map");
    require(command.kind != Command::Kind::FillMask || command.paint < asset.paints.size(), "commands", i,
            "refers to a missing paint");
    const bool isDrawMap = command.kind == Command::Kind::DrawMap;
    require(isDrawMap == (asset.mode == Mode::Exact), "commands", i,
            isDrawMap ? "draws a map in compat mode" : "draws layers in exact mode");
    if (command.kind == Command::Kind::FillMask || command.kind == Command::Kind::ClipMask)
        require(maps[command.map].largestPaint <= 1, "commands", i,
                "its map is not a mask: it has a paint index above 1");
}

void validateCommands(const AssetView& asset, const std::vector<Extent>& maps) {
    require(asset.commands.size() <= maxCommands, "commands", maxCommands, "there are too many");
    unsigned depth = 1;
    std::uint64_t drawn = 0;
    for (std::size_t i = 0; i < asset.commands.size(); ++i) {
        const Command& command = asset.commands[i];
        validateCommand(asset, maps, i);
        depth = depthAfter(command, depth, i);
        if (drawsMap(command.kind))
            drawn += maps[command.map].drawn;
        require(drawn <= maxDrawn, "commands", i, "more squares and pieces are drawn than the limit");
    }
    require(depth == 1, "commands", asset.commands.size(), "a group is not closed at the end");
}

void validatePrefilter(const PrefilterView& prefilter) {
    const PyramidSize size = prefilter.size;
    if (size == PyramidSize{})
        return require(prefilter.texels.empty(), "prefilter", 0, "there are texels without a size");
    require(isPyramidSide(size.width) && isPyramidSide(size.height), "prefilter", 0,
            "a side is not 2^k or 3 * 2^k texels of at most 4096");
    require(prefilter.texels.size() == size.texelsBefore(size.levels()), "prefilter", prefilter.texels.size(),
            "number of texels does not match the size");
}

}  // namespace

void validate(const AssetView& asset) {
    require(isLength(asset.width) && isLength(asset.height), "picture", 0, "size is out of range");
    require(asset.mode <= Mode::Compat, "picture", 0, "mode is unknown");
    require(!asset.finestPixel || (*asset.finestPixel >= 0 && std::isfinite(*asset.finestPixel)), "accuracy",
            0, "finest pixel is out of range");
    validatePaints(asset);
    validatePieces(asset);
    const Trees trees(asset);
    std::vector<Extent> maps;
    for (std::size_t i = 0; i < asset.maps.size(); ++i) {
        validateMap(asset, i);
        maps.push_back(trees.extentOf(asset.maps[i].root, "maps", i));
        require(maps.back().depth <= maxLevel, "maps", i, "tree is too deep");
    }
    validateCommands(asset, maps);
    validatePrefilter(asset.prefilter);
}

}  // namespace vtm::asset
