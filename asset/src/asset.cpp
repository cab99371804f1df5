#include <vtm/asset/asset.hpp>

#include <algorithm>
#include <set>

#include "asset/records.hpp"
#include "asset/walk.hpp"

namespace vtm::asset {

namespace {

template <class Record>
std::vector<Record> copied(std::span<const Record> records) {
    return {records.begin(), records.end()};
}

}  // namespace

bool isSumOfMaps(const AssetView& asset) {
    return asset.mode == Mode::Exact && std::ranges::all_of(asset.commands, [](const Command& command) {
               return command.kind == Command::Kind::DrawMap && command.paint == 0;
           });
}

AssetView::AssetView(const Asset& asset)
    : width(asset.width),
      height(asset.height),
      mode(asset.mode),
      maps(asset.maps),
      commands(asset.commands),
      nodes(asset.nodes),
      leaves(asset.leaves),
      pieces(asset.pieces),
      paints(asset.paints),
      data(asset.data),
      images(asset.images),
      materials(asset.materials),
      instanceTrees(asset.instanceTrees),
      instances(asset.instances),
      symbols(asset.symbols),
      palettes(asset.palettes),
      filters(asset.filters),
      filterPrimitives(asset.filterPrimitives),
      filterWords(asset.filterWords),
      fallbackLeaves(asset.fallbackLeaves),
      filterPixels(asset.filterPixels),
      prefilter{asset.prefilter.size, asset.prefilter.texels},
      finestPixel(asset.finestPixel),
      font(asset.font),
      glyphs(asset.glyphs),
      glyphParts(asset.glyphParts) {}

std::vector<bool> imagesWithLevels(const AssetView& asset) {
    std::vector<bool> wanted(asset.images.size());
    for (const Paint& paint : asset.paints) {
        if (!isProgram(paint))
            continue;
        for (std::uint32_t i = paint[0]; i < paint[0] + paint[1]; ++i) {
            const auto in = recordAt<Instruction>(asset.data, i);
            if (in.op != Op::Image)
                continue;
            const auto fill = recordAt<ImageFill>(asset.data, in.argument);
            if (fill.filter >= ImageFilter::Trilinear)
                wanted[fill.image] = true;
        }
    }
    return wanted;
}

Asset toAsset(const AssetView& view) {
    return {.width = view.width,
            .height = view.height,
            .mode = view.mode,
            .maps = copied(view.maps),
            .commands = copied(view.commands),
            .nodes = copied(view.nodes),
            .leaves = copied(view.leaves),
            .pieces = copied(view.pieces),
            .paints = copied(view.paints),
            .data = copied(view.data),
            .images = copied(view.images),
            .materials = copied(view.materials),
            .instanceTrees = copied(view.instanceTrees),
            .instances = copied(view.instances),
            .symbols = copied(view.symbols),
            .palettes = copied(view.palettes),
            .filters = copied(view.filters),
            .filterPrimitives = copied(view.filterPrimitives),
            .filterWords = copied(view.filterWords),
            .fallbackLeaves = view.fallbackLeaves,
            .filterPixels = view.filterPixels,
            .prefilter = {view.prefilter.size, copied(view.prefilter.texels)},
            .finestPixel = view.finestPixel,
            .font = view.font,
            .glyphs = copied(view.glyphs),
            .glyphParts = copied(view.glyphParts)};
}

namespace {

std::size_t uploadedBytes(const AssetView& asset) {
    std::size_t bytes = asset.nodes.size() * sizeof(Node) + asset.leaves.size() * sizeof(Leaf) +
                        asset.pieces.size() * sizeof(Piece) + asset.paints.size() * sizeof(Paint) +
                        asset.data.size() * sizeof(Texel) + asset.instanceTrees.size_bytes() +
                        asset.instances.size_bytes() + asset.symbols.size_bytes() +
                        asset.palettes.size_bytes();
    for (const image::Bitmap& bitmap : asset.images)
        bytes += bitmap.rgba.size();
    return bytes;
}

}  // namespace

Summary summarize(const AssetView& asset) {
    Summary summary;
    summary.bytes = uploadedBytes(asset);
    summary.prefilterBytes = asset.prefilter.texels.size_bytes();
    summary.leaves = asset.leaves.size();
    summary.pieces = asset.pieces.size();
    summary.instances = asset.instances.size();
    summary.glyphs = asset.glyphs.size();
    summary.regions = std::set<Paint>(asset.paints.begin(), asset.paints.end()).size();
    for (const Map& map : asset.maps)
        walk(asset, map.root, [&](Cell cell, Entry entry) {
            summary.maxDepth = std::max(summary.maxDepth, cell.level);
            summary.solids += entry.kind() == Entry::Kind::Solid;
        });
    return summary;
}

}  // namespace vtm::asset
