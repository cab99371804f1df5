#include "compiler/compile.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "compiler/src/painters.hpp"
#include "compiler/src/walk_items.hpp"

namespace vtm::compiler {
namespace {

using asset::Command;
using asset::Entry;

/// A lattice step is this many bits finer than the tolerance: snapping moves points by a step or two.
constexpr int stepBits = 6;
/// Cells of the last level still have this many steps a side.
constexpr int lastCellBits = 4;

int latticeBits(double tolerance) {
    return std::min(maxLatticeBits, static_cast<int>(std::ceil(-std::log2(tolerance))) + stepBits);
}

void checkOptions(const Options& o) {
    if (!(o.tolerance >= std::ldexp(1.0, -26) && o.tolerance <= std::ldexp(1.0, -6)))
        throw std::invalid_argument("tolerance must lie in [2^-26, 2^-6]");
    if (!(o.nanosecondsPerByte >= 1 && o.nanosecondsPerByte <= 1e6))
        throw std::invalid_argument("nanosecondsPerByte must lie in [1, 1e6]");
    if (o.piecesPerLeaf && (*o.piecesPerLeaf < 1 || *o.piecesPerLeaf > 4096))
        throw std::invalid_argument("piecesPerLeaf must lie in [1, 4096]");
    if (o.maxDepth > asset::maxLevel)
        throw std::invalid_argument("maxDepth must be at most " + std::to_string(asset::maxLevel));
}

TreeOptions treeOptions(const Options& o) {
    const int bits = latticeBits(o.tolerance);
    TreeOptions t(ErrorBudget(o.tolerance, bits));
    t.cost.nanosecondsPerByte = o.nanosecondsPerByte;
    t.piecesPerLeaf = o.piecesPerLeaf;
    t.maxDepth = std::min(o.maxDepth, static_cast<unsigned>(bits - lastCellBits) / 2);
    t.minDepth = std::min(t.maxDepth, t.budget.coarsestLevel());
    return t;
}

std::vector<std::uint32_t> allLayers(const Picture& picture) {
    std::vector<std::uint32_t> layers(picture.layers.size());
    for (std::uint32_t i = 0; i < layers.size(); ++i)
        layers[i] = i;
    return layers;
}

/// Appends a tree's records to the asset; `paints`: the index of each of its paints.
asset::Entry encode(const Tree& tree, std::span<const std::uint16_t> paints, asset::Asset& asset) {
    const auto nodes = static_cast<std::uint32_t>(asset.nodes.size()),
               leaves = static_cast<std::uint32_t>(asset.leaves.size()),
               pieces = static_cast<std::uint32_t>(asset.pieces.size());
    const auto entry = [&](Entry e) {
        switch (e.kind()) {
            case Entry::Kind::Solid:
                return Entry::make(e.kind(), paints[e.payload()]);
            case Entry::Kind::Leaf:
                return Entry::make(e.kind(), e.payload() + leaves);
            case Entry::Kind::Node:
                break;
        }
        return Entry::make(e.kind(), e.payload() + nodes);
    };
    for (asset::Node node : tree.nodes) {
        for (Entry& e : node.children)
            e = entry(e);
        asset.nodes.push_back(node);
    }
    for (const Tree::Leaf& l : tree.leaves) {
        asset::Leaf leaf;
        leaf.firstPiece = l.firstPiece + pieces;
        leaf.pieceCount = static_cast<std::uint16_t>(l.pieceCount);
        for (std::size_t k = 0; k < 4; ++k)
            leaf.corners[k] = paints[l.corners[k]];
        asset.leaves.push_back(leaf);
    }
    for (const Tree::Piece& p : tree.pieces)
        asset.pieces.push_back({p.a, p.b, p.slopeA, p.slopeB, paints[p.left], paints[p.right]});
    asset.fallbackLeaves += static_cast<std::uint32_t>(tree.unproven.size());
    return entry(tree.root);
}

/// Maps over the lattice's root square.
class MapBuilder {
public:
    MapBuilder(const Picture& picture, const Lattice& lattice, const Options& options, Result& result)
        : picture_(picture), lattice_(lattice), options_(treeOptions(options)), result_(result) {}

    Tree build(std::span<const std::uint32_t> layers, const Painter& painter) {
        return buildTree(picture_, lattice_.square(), layers, painter, options_, times_);
    }
    std::uint32_t add(const Tree& tree, std::span<const std::uint16_t> paints) {
        asset::Asset& asset = result_.asset;
        const Entry root = encode(tree, paints, asset);
        asset.maps.push_back({0, 0, std::max(asset.width, asset.height), root});
        certify(tree);
        return static_cast<std::uint32_t>(asset.maps.size() - 1);
    }
    const TreeTimes& times() const { return times_; }

private:
    void certify(const Tree& tree) {
        const ErrorBudget& budget = options_.budget;
        result_.provenError = std::max(result_.provenError, budget.share(tree.error));
        const double longer = std::max(result_.asset.width, result_.asset.height);
        const auto picture = [&](Coord steps) { return longer * budget.share(steps + 1.0); };
        for (const Square& s : tree.unproven)
            result_.unproven.push_back({picture(s.x0), picture(s.y0), longer * budget.share(s.side)});
    }

    const Picture& picture_;
    const Lattice& lattice_;
    const TreeOptions options_;
    Result& result_;
    TreeTimes times_;
};

/// Returns by how much merging colours that the format cannot all name may have changed one.
float compileExact(const Picture& picture, MapBuilder& maps, asset::Asset& asset) {
    const Tree tree = maps.build(allLayers(picture), PicturePainter(picture));
    float error = 0;
    const std::vector<std::uint16_t> paints = encodePalette(tree.palette, asset, error);
    Command draw;
    draw.kind = Command::Kind::DrawMap;
    draw.map = maps.add(tree, paints);
    asset.commands.push_back(draw);
    return error;
}

/// Compat mode: every item and every clip is a mask of its own; groups become commands.
class CompatCompiler {
public:
    CompatCompiler(const Picture& picture, MapBuilder& maps, asset::Asset& asset)
        : picture_(picture), maps_(maps), asset_(asset) {
        palette_.solid({1, 1, 1, 1});  // a mask's paint 1
    }

    float run() {
        ItemWalk<CompatCompiler> walk(picture_, *this);
        for (const PictureItem& item : picture_.items)
            walk.item(item);
        walk.finish();
        float error = 0;
        const std::vector<std::uint16_t> paints = encodePalette(palette_, asset_, error);
        for (Command& command : asset_.commands)
            command.paint = paints[command.paint];
        return error;
    }

    void open(std::uint32_t) { emit(Command::Kind::Push); }

    void item(const PictureItem& item) {
        MaskPainter painter(picture_, item.layer, none);
        Command& fill = emit(Command::Kind::FillMask);
        fill.paint = paintOf(item);
        const std::uint32_t layer[] = {item.layer};
        fill.map = addMask(layer, painter);
    }

    void emptyMask(std::uint32_t) {
        emit(Command::Kind::Push);
        emit(Command::Kind::PopMaskAlpha);
    }

    void close(std::uint32_t index) {
        const PictureGroup& group = picture_.groups[index];
        if (group.clip != none)
            emit(Command::Kind::ClipMask).map = clipMap(group.clip);
        if (group.role != GroupRole::Plain) {
            emit(group.role == GroupRole::AlphaMask       ? Command::Kind::PopMaskAlpha
                 : group.role == GroupRole::LuminanceMask ? Command::Kind::PopMaskLuminance
                                                          : Command::Kind::PopMaskLinear);
            return;
        }
        Command& pop = emit(Command::Kind::Pop);
        pop.blend = group.adds ? asset::Blend::PlusLighter : static_cast<asset::Blend>(group.blend);
        pop.opacity = group.opacity;
    }

private:
    Command& emit(Command::Kind kind) {
        Command command;
        command.kind = kind;
        asset_.commands.push_back(command);
        return asset_.commands.back();
    }

    std::uint32_t addMask(std::span<const std::uint32_t> layers, const MaskPainter& painter) {
        constexpr std::array<std::uint16_t, 2> paints{0, 1};
        return maps_.add(maps_.build(layers, painter), paints);
    }

    PaintId paintOf(const PictureItem& item) {
        const Source& source = picture_.sources[item.source];
        if (source.op != asset::Op::Solid)
            return palette_.add({{{source.op, asset::Blend::Normal, item.opacity, source.data}, {}}});
        Color color = source.color;
        for (float& c : color)
            c *= item.opacity;
        return palette_.solid(color);
    }

    std::uint32_t clipMap(std::uint32_t clip) {
        std::vector<std::uint32_t> layers;
        collectLayers(clip, layers);
        std::sort(layers.begin(), layers.end());
        MaskPainter painter(picture_, none, clip);
        return addMask(layers, painter);
    }

    void collectLayers(std::uint32_t clip, std::vector<std::uint32_t>& into) const {
        if (clip == none)
            return;
        for (const ClipExpression::Term& term : picture_.clips[clip].terms) {
            into.push_back(term.layer);
            collectLayers(term.clip, into);
        }
        collectLayers(picture_.clips[clip].outer, into);
    }

    const Picture& picture_;
    MapBuilder& maps_;
    asset::Asset& asset_;
    Palette palette_;
};

}  // namespace

Result compile(const scene::Scene& scene, const Options& options) {
    checkOptions(options);
    scene::validate(scene);

    using Clock = std::chrono::steady_clock;
    const auto milliseconds = [](Clock::time_point a, Clock::time_point b) {
        return std::chrono::duration<double, std::milli>(b - a).count();
    };
    const auto start = Clock::now();
    const int bits = latticeBits(options.tolerance);
    const Lattice lattice(scene.width, scene.height, bits);
    Picture picture = lower(scene, lattice, ErrorBudget(options.tolerance, bits));
    const auto lowered = Clock::now();

    Result result;
    result.sampledStrokes = picture.sampledStrokes;
    asset::Asset& asset = result.asset;
    asset.width = scene.width;
    asset.height = scene.height;
    asset.mode = options.mode;
    asset.data = std::move(picture.data);
    asset.images = std::move(picture.images);
    asset.materials = std::move(picture.materials);
    MapBuilder maps(picture, lattice, options, result);
    float error = 0;
    if (options.mode == asset::Mode::Exact)
        error = compileExact(picture, maps, asset);
    else
        error = CompatCompiler(picture, maps, asset).run();

    const TreeTimes& t = maps.times();
    const double built = milliseconds(lowered, Clock::now());
    result.stages = {{"lower", milliseconds(start, lowered)},
                     {"push", t.push},
                     {"planarise", t.planarise},
                     {"fit", t.fit},
                     {"encode", built - t.push - t.planarise - t.fit}};
    if (asset.fallbackLeaves > 0)
        result.warnings.push_back(std::to_string(asset.fallbackLeaves) +
                                  " leaves could not be certified and are filled with the mean of samples");
    if (result.provenError > options.tolerance)
        result.warnings.push_back("boundaries are proven to lie within " +
                                  std::to_string(result.provenError / options.tolerance) +
                                  " tolerances only");
    if (error > 0)
        result.warnings.push_back("more than 65536 region colours: the nearest were merged, by up to " +
                                  std::to_string(error) + " in a component");
    return result;
}

}  // namespace vtm::compiler
