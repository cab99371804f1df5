#include <vtm/compiler/compile.hpp>

#include <algorithm>

#include <fmt/format.h>

#include "compiler/compile/settings.hpp"
#include "compiler/filters/compile_filtered.hpp"
#include "compiler/instances/encode_instances.hpp"
#include "compiler/instances/place_symbols.hpp"
#include "compiler/lower/walk_items.hpp"
#include "compiler/paint/painters.hpp"
#include "compiler/patterns/pattern_images.hpp"
#include "compiler/tree/build_tree.hpp"
#include "compiler/tree/encode.hpp"
#include "compiler/tree/tree.hpp"

namespace vtm::compiler {
namespace {

using asset::Command;

std::vector<std::uint32_t> allLayers(const LoweredScene& picture) {
    std::vector<std::uint32_t> layers(picture.layers.size());
    for (std::uint32_t i = 0; i < layers.size(); ++i)
        layers[i] = i;
    return layers;
}

/// Of a mask's tree: whether the mask covers a part of the square.
bool isCovered(asset::Entry entry) {
    return entry.kind() != asset::Entry::Kind::Solid || entry.payload() != 0;
}

/// Makes the map of a mask as small as the smallest of its squares that holds all that it covers, so that
/// engines need not look for that in the whole picture.
void tighten(asset::Map& map, const std::vector<asset::Node>& nodes) {
    while (map.root.kind() == asset::Entry::Kind::Node) {
        const std::array<asset::Entry, 16>& children = nodes[map.root.payload()].children;
        if (std::ranges::count_if(children, isCovered) != 1)
            return;
        const auto at = std::ranges::find_if(children, isCovered) - children.begin();
        map.side /= 4;
        map.x += map.side * double(at % 4);
        map.y += map.side * double(at / 4);
        map.root = children[std::size_t(at)];
    }
}

/// Maps over the lattice's root square.
class MapBuilder {
public:
    MapBuilder(const LoweredScene& picture, const Lattice& lattice, const Options& options, Result& result)
        : picture_(picture), lattice_(lattice), options_(treeOptions(options)), result_(result) {}

    JoinedTree build(std::span<const std::uint32_t> layers, const Painter& painter) {
        return buildTree(picture_, lattice_.square(), layers, painter, options_, times_);
    }
    std::uint32_t add(JoinedTree joined, std::span<const std::uint16_t> paints) {
        asset::Asset& asset = result_.asset;
        certify(joined.tree, options_.budget, result_);
        const asset::Entry root = encodeTree(std::move(joined), paints, asset);
        asset.maps.push_back({0, 0, std::max(asset.width, asset.height), root});
        checkDrawn(asset.maps.size(), asset.nodes.size(), asset.pieces.size());
        return static_cast<std::uint32_t>(asset.maps.size() - 1);
    }
    const TreeTimes& times() const { return times_; }

private:
    const LoweredScene& picture_;
    const Lattice& lattice_;
    const TreeOptions options_;
    Result& result_;
    TreeTimes times_;
};

/// Returns by how much merging colours that the format cannot all name may have changed one. Takes the
/// picture's outlines.
float compileExact(LoweredScene& picture, MapBuilder& maps, const PlacedSymbols& placed,
                   const Palette& placedPaints, asset::Asset& asset) {
    JoinedTree joined = maps.build(placed.layers, PicturePainter(picture));
    picture.outlines = {};  // much of the memory, before the asset takes some
    Tree& tree = joined.tree;
    std::vector<PaintId> inTree(placedPaints.size());
    for (const PlacedSymbol& symbol : placed.placed)
        for (const PaintId id : symbol.paints)
            inTree[id] = tree.palette.add(placedPaints[id]);
    float error = 0;
    const std::vector<std::uint16_t> paints = encodePalette(tree.palette, asset, error);
    asset.nodes.reserve(tree.nodes.size());
    asset.leaves.reserve(tree.leaves.size());
    Command draw;
    draw.kind = Command::Kind::DrawMap;
    draw.map = maps.add(std::move(joined), paints);
    asset.commands.push_back(draw);
    std::vector<std::uint16_t> ofPlaced;
    for (const PaintId id : inTree)
        ofPlaced.push_back(paints[id]);
    encodeInstances(placed, ofPlaced, asset);
    return error;
}

/// Compat mode: every item and every clip is a mask of its own; groups become commands.
class CompatCompiler {
public:
    CompatCompiler(const LoweredScene& picture, MapBuilder& maps, asset::Asset& asset)
        : picture_(picture), maps_(maps), asset_(asset) {
        palette_.solid({1, 1, 1, 1});  // a mask's paint 1
    }

    float run() {
        ItemWalk<CompatCompiler> walk(picture_, *this);
        for (const LoweredItem& item : picture_.items)
            walk.item(item);
        walk.finish();
        float error = 0;
        const std::vector<std::uint16_t> paints = encodePalette(palette_, asset_, error);
        for (Command& command : asset_.commands)
            command.paint = paints[command.paint];
        return error;
    }

    void open(std::uint32_t) {
        push();
        ++depth_;
    }

    void item(const LoweredItem& item) {
        MaskPainter painter(picture_, item.layer, noIndex);
        const std::uint32_t layer[] = {item.layer};
        JoinedTree mask = maps_.build(layer, painter);
        if (!isCovered(mask.tree.root))
            return;  // it lies outside of the picture
        Command& fill = emit(Command::Kind::FillMask);
        fill.paint = paintOf(item);
        fill.map = addMask(std::move(mask));
    }

    void emptyMask(std::uint32_t) {
        push();
        emit(Command::Kind::PopMaskAlpha);
    }

    void close(std::uint32_t index) {
        --depth_;
        const LoweredGroup& group = picture_.groups[index];
        if (group.clip != noIndex)
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
        if (asset_.commands.size() >= asset::maxCommands)
            throw LimitError("the picture needs more than " + std::to_string(asset::maxCommands) +
                             " commands in compat mode");
        Command command;
        command.kind = kind;
        asset_.commands.push_back(command);
        return asset_.commands.back();
    }

    void push() {
        if (depth_ == asset::maxPictures)
            throw LimitError("groups are nested more than " + std::to_string(asset::maxPictures - 1) +
                             " levels deep, the limit of compat mode");
        emit(Command::Kind::Push);
    }

    std::uint32_t addMask(JoinedTree mask) {
        constexpr std::array<std::uint16_t, 2> paints{0, 1};
        const std::uint32_t map = maps_.add(std::move(mask), paints);
        tighten(asset_.maps[map], asset_.nodes);
        return map;
    }

    PaintId paintOf(const LoweredItem& item) {
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
        return addMask(maps_.build(layers, MaskPainter(picture_, noIndex, clip)));
    }

    void collectLayers(std::uint32_t clip, std::vector<std::uint32_t>& into) const {
        if (clip == noIndex)
            return;
        for (const ClipExpression::Term& term : picture_.clips[clip].terms) {
            into.push_back(term.layer);
            collectLayers(term.clip, into);
        }
        collectLayers(picture_.clips[clip].outer, into);
    }

    const LoweredScene& picture_;
    MapBuilder& maps_;
    asset::Asset& asset_;
    Palette palette_;
    unsigned depth_ = 1;  ///< pictures on the stack
};

}  // namespace

Result compile(const scene::Scene& scene, const Options& options) {
    checkOptions(options);
    const limits::Stage stage("compiling");
    scene::validate(scene);
    return compileExcerpt(scene, wholeOf(scene), options);
}

namespace {

/// A lowered scene, and what of it is placed.
struct Lowered {
    LoweredScene picture;
    PlacedSymbols placed;
    Palette paints;  ///< of what is placed
};

Lowered withoutInstances(LoweredScene picture) {
    Lowered lowered{std::move(picture), {}, {}};
    lowered.placed.layers = allLayers(lowered.picture);
    return lowered;
}

Lowered lowerAndPlace(const scene::Scene& scene, const Excerpt& excerpt, const Lattice& lattice,
                      const Options& options, DrawnTiles* tiles) {
    // Where coverage is a factor, fills end where they are told to.
    const Sharing sharing = options.mode == asset::Mode::Exact ? Sharing::Outlines : Sharing::None;
    const ErrorBudget budget = errorBudget(options);
    PatternImages images(options, std::max(excerpt.width, excerpt.height), tiles);
    const auto flat = [&] {
        return withoutInstances(
            lower(scene, excerpt, lattice, budget, sharing, nullptr, nullptr, nullptr, &images));
    };
    if (!options.instances || options.mode != asset::Mode::Exact || excerpt.isPart)
        return flat();
    const glm::dvec2 size(excerpt.width, excerpt.height);
    Lowered lowered;
    std::vector<LayerOrigin> origins;
    TilePlan plan;
    lowered.picture = lower(scene, excerpt, lattice, budget, sharing, nullptr, &origins, &plan, &images);
    std::vector<TileFill> fills;
    if (!plan.patterns.empty()) {
        const std::vector<TileChoice> choices =
            chooseTiles(lowered.picture, lattice, size, plan.patterns, options.tolerance);
        TilePlan chosen;
        chosen.chosen.emplace();
        for (const TileChoice& choice : choices)
            chosen.chosen->push_back({choice.cut, choice.isImage});
        origins.clear();
        lowered.picture =
            lower(scene, excerpt, lattice, budget, sharing, nullptr, &origins, &chosen, &images);
        for (std::size_t i = 0; i < choices.size(); ++i)
            if (!choices[i].blocks.empty())
                fills.push_back(
                    {chosen.patterns[i], choices[i].blocks, chosen.firstTiles[i], choices[i].cut.front()});
    }
    auto placed = placeSymbols(lowered.picture, origins, fills, lattice, size, options, lowered.paints);
    if (!placed)
        return flat();
    lowered.placed = std::move(*placed);
    return lowered;
}

Result compilePlain(const scene::Scene& scene, const Excerpt& excerpt, const Options& options,
                    DrawnTiles* tiles) {
    const auto start = Clock::now();
    const Lattice lattice(excerpt.width, excerpt.height, latticeBits(options));
    auto [picture, placed, placedPaints] = lowerAndPlace(scene, excerpt, lattice, options, tiles);
    const auto lowered = Clock::now();

    Result result;
    result.sampledStrokes = picture.sampledStrokes;
    asset::Asset& asset = result.asset;
    asset.width = excerpt.width;
    asset.height = excerpt.height;
    asset.mode = options.mode;
    asset.data = std::move(picture.data);
    asset.images = bitmapsOf(picture);
    asset.materials = std::move(picture.materials);
    MapBuilder maps(picture, lattice, options, result);
    float error = 0;
    if (options.mode == asset::Mode::Exact)
        error = compileExact(picture, maps, placed, placedPaints, asset);
    else
        error = CompatCompiler(picture, maps, asset).run();

    result.provenError = std::max(result.provenError, placed.error / std::max(excerpt.width, excerpt.height));
    asset.finestPixel = finestPixel(result);
    const TreeTimes& t = maps.times();
    const double built = milliseconds(lowered, Clock::now());
    result.stages = stageTimes(milliseconds(start, lowered), built, t);
    result.warnings = warningsOf(result, options, error);
    result.warnings.insert(result.warnings.end(), picture.warnings.begin(), picture.warnings.end());
    return result;
}

}  // namespace

Result compileExcerpt(const scene::Scene& scene, const Excerpt& excerpt, const Options& options,
                      DrawnTiles* tiles) {
    const auto plain = [tiles](const scene::Scene& part, const Excerpt& of, const Options& how) {
        return compilePlain(part, of, how, tiles);
    };
    return hasFilters(scene) ? compileFiltered(scene, excerpt, options, plain)
                             : plain(scene, excerpt, options);
}

}  // namespace vtm::compiler
