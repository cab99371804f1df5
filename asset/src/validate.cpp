#include "asset/src/validate.hpp"

#include <algorithm>
#include <cmath>

#include "asset/instances.hpp"
#include "asset/walk.hpp"

namespace vtm::asset {

namespace {

/// What a tree below an entry amounts to. Found for leaves, then for nodes from the last to the first,
/// since children have larger indices: every node is looked at once, however often it is shared.
struct Extent {
    std::uint64_t drawn = 1;  ///< squares and pieces; saturates above maxDrawn
    std::uint32_t depth = 0;
    std::uint32_t largestPaint = 0;
    std::uint32_t maps = 1;     ///< in each other
    bool isPicture = false;     ///< it has leaves, or paints other than 0
    bool hasInstances = false;  ///< it is a tree of instances

    void include(const Extent& child) {
        drawn = std::min(drawn + child.drawn, maxDrawn + 1);
        depth = std::max(depth, child.depth + 1);
        largestPaint = std::max(largestPaint, child.largestPaint);
        isPicture = isPicture || child.isPicture;
        hasInstances = hasInstances || child.hasInstances;
    }
};

/// Paints are named with so many numbers.
constexpr std::size_t maxPaintNumbers = 0x10000;

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
                require(entry.payload() < (asset_.symbols.empty() ? asset_.paints.size() : maxPaintNumbers),
                        section, index, "entry refers to a missing paint");
                return {1, 0, entry.payload(), 1, entry.payload() != 0, false};
            case Entry::Kind::Leaf:
                require(entry.payload() < leaves_.size(), section, index, "entry refers to a missing leaf");
                return leaves_[entry.payload()];
            case Entry::Kind::Node:
                require(entry.payload() < nodes_.size(), section, index, "entry refers to a missing node");
                return nodes_[entry.payload()];
            case Entry::Kind::Instances:
                break;
        }
        return {1, 0, 0, 1, false, true};
    }

private:
    Extent leafExtentOf(std::size_t i) const {
        const Leaf& leaf = asset_.leaves[i];
        require(leaf.unused == 0, "leaves", i, "unused half is not zero");
        require(leaf.firstPiece <= asset_.pieces.size() &&
                    leaf.pieceCount <= asset_.pieces.size() - leaf.firstPiece,
                "leaves", i, "piece range is out of bounds");
        Extent extent{1u + leaf.pieceCount, 0, *std::ranges::max_element(leaf.corners), 1, true, false};
        for (std::size_t p = leaf.firstPiece; p < std::size_t(leaf.firstPiece) + leaf.pieceCount; ++p)
            extent.largestPaint =
                std::max<std::uint32_t>({extent.largestPaint, asset_.pieces[p].left, asset_.pieces[p].right});
        require(!asset_.symbols.empty() || extent.largestPaint < asset_.paints.size(), "leaves", i,
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
}

/// The maps, from the last to the first: those that are placed in a map have larger indices.
class Maps {
public:
    Maps(const AssetView& asset, const Trees& trees)
        : asset_(asset),
          trees_(trees),
          extents_(asset.maps.size()),
          isPlaced_(asset.maps.size()),
          nodeSeen_(asset.nodes.size()),
          treeSeen_(asset.instanceTrees.size()),
          instanceSeen_(asset.instances.size()) {
        require(asset.symbols.empty() || asset.mode == Mode::Exact, "symbols", 0,
                "there are some in compat mode");
        require(asset.instances.size() <= maxInstances, "instances", maxInstances, "there are too many");
        for (std::size_t i = 0; i < asset.symbols.size(); ++i)
            validateSymbol(i);
        for (std::size_t i = asset.maps.size(); i-- > 0;)
            validateMap(i);
        const auto missed = std::ranges::find(instanceSeen_, false);
        require(missed == instanceSeen_.end(), "instances", std::size_t(missed - instanceSeen_.begin()),
                "is in no map");
        for (std::size_t i = 0; i < asset.maps.size(); ++i)
            require(isPlaced_[i] || extents_[i].largestPaint < asset.paints.size(), "maps", i,
                    "refers to a missing paint");
    }
    const std::vector<Extent>& extents() const { return extents_; }
    bool isPlaced(std::size_t map) const { return isPlaced_[map]; }

private:
    void validateSymbol(std::size_t i) {
        const Symbol& symbol = asset_.symbols[i];
        require(symbol.unused == 0, "symbols", i, "unused word is not zero");
        require(symbol.map < asset_.maps.size(), "symbols", i, "refers to a missing map");
        require(std::isfinite(symbol.scale) && symbol.scale > 0, "symbols", i, "scale is out of range");
        isPlaced_[symbol.map] = true;
    }

    void validateMap(std::size_t i) {
        asset::validateMap(asset_, i);
        const Map& map = asset_.maps[i];
        Extent& extent = extents_[i];
        extent = trees_.extentOf(map.root, "maps", i);
        require(extent.depth <= maxLevel, "maps", i, "tree is too deep");
        require(!extent.hasInstances, "maps", i, "entry's kind is unknown");
        for (std::uint32_t tree = map.instances; tree != 0; tree = asset_.instanceTrees[tree - 1].next)
            addTree(tree - 1, std::uint32_t(i), extent);
        require(extent.maps <= maxMapDepth, "maps", i, "maps are nested too deeply");
    }

    void addTree(std::size_t index, std::uint32_t map, Extent& extent) {
        require(index < treeSeen_.size(), "maps", map, "refers to a missing tree of instances");
        require(!treeSeen_[index], "instance trees", index, "belongs to several maps");
        treeSeen_[index] = true;
        const InstanceTree& tree = asset_.instanceTrees[index];
        require(tree.unused == 0, "instance trees", index, "unused word is not zero");
        require(tree.next == 0 || tree.next > index + 1, "instance trees", index,
                "the next tree's index is not larger");
        require(tree.reach >= 0 && tree.reach <= 1, "instance trees", index, "reach is out of range");
        require(!trees_.extentOf(tree.root, "instance trees", index).isPicture, "instance trees", index,
                "leaves stand among instances");
        require(trees_.extentOf(tree.root, "instance trees", index).depth <= maxLevel, "instance trees",
                index, "tree is too deep");
        addEntry(tree, tree.root, {}, map, extent);
    }

    /// Every node once, so that the work is bounded.
    void addEntry(const InstanceTree& tree, Entry entry, Cell cell, std::uint32_t map, Extent& extent) {
        if (entry.kind() == Entry::Kind::Instances)
            return addInstances(tree, InstanceRange(entry), cell, map, extent);
        if (entry.kind() != Entry::Kind::Node)
            return;
        const std::uint32_t index = entry.payload();
        require(!nodeSeen_[index], "nodes", index, "is shared by trees of instances");
        nodeSeen_[index] = true;
        for (std::uint32_t i = 0; i < 16; ++i)
            addEntry(tree, asset_.nodes[index].children[i], childOf(cell, i), map, extent);
    }

    void addInstances(const InstanceTree& tree, InstanceRange range, Cell cell, std::uint32_t map,
                      Extent& extent) {
        for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
            require(i < asset_.instances.size(), "instances", i, "is missing");
            require(!instanceSeen_[i], "instances", i, "stands in several places");
            instanceSeen_[i] = true;
            const Instance& instance = asset_.instances[i];
            require(instance.symbol() < asset_.symbols.size(), "instances", i, "refers to a missing symbol");
            const Symbol& symbol = asset_.symbols[instance.symbol()];
            require(symbol.map > map, "instances", i,
                    "the index of its map is not larger than that of the map around");
            const unsigned shift = 2 * (maxLevel - cell.level);
            const auto [x, y] = instance.centre();
            require(x >> shift == cell.x && y >> shift == cell.y, "instances", i,
                    "its centre lies outside its cell");
            requireWithin(tree, symbol, i);
            include(symbol, i, extent);
        }
    }

    void requireWithin(const InstanceTree& tree, const Symbol& symbol, std::size_t i) const {
        const auto [m00, m01, m10, m11] = asset_.instances[i].linear();
        const double step = 0.5 * double(symbol.scale) / double(slopeScale);
        require(step * (std::abs(m00) + std::abs(m10)) <= tree.reach &&
                    step * (std::abs(m01) + std::abs(m11)) <= tree.reach,
                "instances", i, "is larger than its tree says");
        require(m00 >= -slopeScale && m01 >= -slopeScale && m10 >= -slopeScale && m11 >= -slopeScale &&
                    m00 * m11 != m01 * m10,
                "instances", i, "is flat, or a coefficient is below -1");
    }

    /// Its own paints count as work: whoever draws it looks them up.
    void include(const Symbol& symbol, std::size_t i, Extent& extent) const {
        const Extent& inner = extents_[symbol.map];
        require(std::uint64_t(symbol.palette) + inner.largestPaint <= asset_.palettes.size(), "instances", i,
                "its symbol's palette is out of bounds");
        extent.drawn = std::min(extent.drawn + inner.drawn + inner.largestPaint, maxDrawn + 1);
        extent.maps = std::max(extent.maps, inner.maps + 1);
        extent.largestPaint = std::max<std::uint32_t>(extent.largestPaint, symbol.ground);
        for (const std::uint16_t paint : asset_.palettes.subspan(symbol.palette, inner.largestPaint))
            extent.largestPaint = std::max<std::uint32_t>(extent.largestPaint, paint);
    }

    const AssetView& asset_;
    const Trees& trees_;
    std::vector<Extent> extents_;
    std::vector<bool> isPlaced_, nodeSeen_, treeSeen_, instanceSeen_;
};

bool drawsMap(Command::Kind kind) {
    return kind == Command::Kind::DrawMap || kind == Command::Kind::FillMask ||
           kind == Command::Kind::ClipMask;
}

/// The stack of pictures as the commands change it. The inputs of a filter lie on each other.
class PictureStack {
public:
    explicit PictureStack(const AssetView& asset) : asset_(asset) {}

    void run(std::size_t i) {
        const Command& command = asset_.commands[i];
        switch (command.kind) {
            case Command::Kind::Push:
                return push({plain, 0}, i);
            case Command::Kind::PushInput:
                return push(inputAfter(pictures_.back(), command.map), i);
            case Command::Kind::Filter:
                return filter(command.map, i);
            default:
                if (drawsMap(command.kind))
                    return;
                require(pictures_.size() > 1 && pictures_.back().filter == plain, "commands", i,
                        "pops the last picture, or an input of a filter");
                pictures_.pop_back();
        }
    }
    bool isAtEnd() const { return pictures_.size() == 1; }

private:
    static constexpr std::uint32_t plain = 0xFFFFFFFFu;
    struct Picture {
        std::uint32_t filter, number;  ///< an input of that filter
    };

    std::uint32_t inputs(std::uint32_t filter) const { return asset_.filters[filter].pictures; }

    Picture inputAfter(const Picture& below, std::uint32_t filter) const {
        const bool goesOn = below.filter == filter && below.number + 1 < inputs(filter);
        return {filter, goesOn ? below.number + 1 : 0};
    }
    void push(const Picture& picture, std::size_t i) {
        require(pictures_.size() < maxPictures, "commands", i, "stack of pictures overflows");
        pictures_.push_back(picture);
    }
    void filter(std::uint32_t index, std::size_t i) {
        const Picture& last = pictures_.back();
        require(last.filter == index && last.number + 1 == inputs(index), "commands", i,
                "filters pictures that were not pushed for it");
        pictures_.resize(pictures_.size() - inputs(index));
        push({plain, 0}, i);
    }

    const AssetView& asset_;
    std::vector<Picture> pictures_{{plain, 0}};
};

bool usesFilter(Command::Kind kind) {
    return kind == Command::Kind::PushInput || kind == Command::Kind::Filter;
}

void validateCommand(const AssetView& asset, const Maps& maps, std::size_t i) {
    const Command& command = asset.commands[i];
    require(command.kind <= Command::Kind::Filter, "commands", i, "kind is unknown");
    require(command.blend <= Blend::PlusLighter, "commands", i, "blend mode is unknown");
    require(isShare(command.opacity), "commands", i, "opacity is out of range");
    require(!drawsMap(command.kind) || command.map < asset.maps.size(), "commands", i,
            "refers to a missing map");
    require(!drawsMap(command.kind) || !maps.isPlaced(command.map), "commands", i,
            "draws a map that is placed in another");
    require(command.kind != Command::Kind::DrawMap || command.paint == 0 ||
                std::uint64_t(command.paint) + maps.extents()[command.map].largestPaint < asset.paints.size(),
            "commands", i, "its map refers to missing paints");
    require(command.kind != Command::Kind::FillMask || command.paint < asset.paints.size(), "commands", i,
            "refers to a missing paint");
    require(!usesFilter(command.kind) || command.map < asset.filters.size(), "commands", i,
            "refers to a missing filter");
    const bool isMask = command.kind == Command::Kind::FillMask || command.kind == Command::Kind::ClipMask;
    require(asset.mode == Mode::Exact || command.kind != Command::Kind::DrawMap, "commands", i,
            "draws a map in compat mode");
    require(asset.mode != Mode::Exact || !(isMask || (!drawsMap(command.kind) && asset.filters.empty())),
            "commands", i, "draws layers in exact mode");
    if (isMask)
        require(maps.extents()[command.map].largestPaint <= 1, "commands", i,
                "its map is not a mask: it has a paint index above 1");
}

void validateCommands(const AssetView& asset, const Maps& maps) {
    require(asset.commands.size() <= maxCommands, "commands", maxCommands, "there are too many");
    PictureStack stack(asset);
    std::uint64_t drawn = 0;
    for (std::size_t i = 0; i < asset.commands.size(); ++i) {
        const Command& command = asset.commands[i];
        validateCommand(asset, maps, i);
        stack.run(i);
        if (drawsMap(command.kind))
            drawn += maps.extents()[command.map].drawn;
        require(drawn <= maxDrawn, "commands", i, "more squares and pieces are drawn than the limit");
    }
    require(stack.isAtEnd(), "commands", asset.commands.size(), "a group is not closed at the end");
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

void validateFont(const AssetView& asset) {
    require(asset.font.has_value() == !asset.glyphs.empty(), "font", 0,
            "is there without glyphs, or they without it");
    if (asset.font)
        require(std::isfinite(asset.font->ascent) && std::isfinite(asset.font->descent), "font", 0,
                "a height is out of range");
    for (std::size_t i = 0; i < asset.glyphs.size(); ++i) {
        const Glyph& glyph = asset.glyphs[i];
        require(i == 0 || asset.glyphs[i - 1].id < glyph.id, "glyphs", i, "ids do not ascend");
        require(glyph.firstPart() + glyph.partCount() <= asset.glyphParts.size(), "glyphs", i,
                "refers to missing parts");
        require(std::isfinite(glyph.advance), "glyphs", i, "advance is out of range");
    }
    require(asset.font || asset.glyphParts.empty(), "glyph parts", 0, "are there without glyphs");
    for (std::size_t i = 0; i < asset.glyphParts.size(); ++i) {
        const GlyphPart& part = asset.glyphParts[i];
        require(part.unused == 0, "glyph parts", i, "unused word is not zero");
        require(part.map < asset.maps.size(), "glyph parts", i, "refers to a missing map");
        require(asset.maps[part.map].instances == 0, "glyph parts", i, "its map holds others");
        require(std::isfinite(part.x) && std::isfinite(part.y), "glyph parts", i, "place is out of range");
    }
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
    const Maps maps(asset, trees);
    validateFilters(asset);
    validateCommands(asset, maps);
    validatePrefilter(asset.prefilter);
    validateFont(asset);
}

}  // namespace vtm::asset
