#include "backend_gl/layers/instances.hpp"

#include <algorithm>

#include <glm/common.hpp>

#include "asset/walk.hpp"

namespace vtm::gl {

namespace {

using asset::Cell;
using asset::Entry;
using Command = asset::Command;

bool isProgram(const asset::AssetView& asset, std::uint32_t paint) {
    return asset::isProgram(asset.paints[paint]);
}

bool usesPrograms(const asset::AssetView& asset, const asset::Leaf& leaf) {
    const auto program = [&](std::uint32_t paint) { return isProgram(asset, paint); };
    const auto* first = asset.pieces.data() + leaf.firstPiece;
    return std::ranges::any_of(leaf.corners, program) ||
           std::any_of(first, first + leaf.pieceCount, [&](const asset::Piece& piece) {
               return program(piece.left) || program(piece.right);
           });
}

CostClass costOf(const asset::AssetView& asset, bool coverage, Entry entry) {
    const bool solid = entry.kind() == Entry::Kind::Solid;
    if (!coverage &&
        (solid ? isProgram(asset, entry.payload()) : usesPrograms(asset, asset.leaves[entry.payload()])))
        return CostClass::General;
    return solid ? CostClass::Solid : CostClass::Pieces;
}

bool isTransparent(const asset::AssetView& asset, bool coverage, Entry entry) {
    if (entry.kind() != Entry::Kind::Solid)
        return false;
    return coverage ? entry.payload() == 0 : asset.paints[entry.payload()] == asset::Paint{};
}

/// The maps that the commands draw, each once a meaning, in order of first use.
void listUses(const asset::AssetView& asset, InstanceList& list) {
    list.asColor.resize(asset.maps.size());
    list.asCoverage.resize(asset.maps.size());
    for (const Command& command : asset.commands) {
        const bool coverage =
            command.kind == Command::Kind::FillMask || command.kind == Command::Kind::ClipMask;
        if (!coverage && command.kind != Command::Kind::DrawMap)
            continue;
        auto& use = (coverage ? list.asCoverage : list.asColor)[command.map];
        if (use)
            continue;
        use = std::uint32_t(list.drawn.size());
        list.drawn.push_back({command.map, coverage, {}, glm::uvec2(~0u), glm::uvec2(0)});
    }
}

void grow(DrawnMap& drawn, Cell cell) {
    const std::uint32_t units = 1u << (2 * (asset::maxLevel - cell.level));
    drawn.min = glm::min(drawn.min, glm::uvec2(cell.x, cell.y) * units);
    drawn.max = glm::max(drawn.max, glm::uvec2(cell.x + 1, cell.y + 1) * units);
}

using ByClass = std::array<std::vector<Instance>, costClassCount>;

void addMap(const asset::AssetView& asset, DrawnMap& drawn, ByClass& instances) {
    for (unsigned c = 0; c < costClassCount; ++c)
        drawn.ranges[c].first = instances[c].size();
    asset::walk(asset, asset.maps[drawn.map].root, [&](Cell cell, Entry entry) {
        if (isTransparent(asset, drawn.coverage, entry))
            return;
        grow(drawn, cell);
        instances[unsigned(costOf(asset, drawn.coverage, entry))].push_back(
            {cell.x, cell.y, cell.level | drawn.map << 4, entry.bits});
    });
    for (unsigned c = 0; c < costClassCount; ++c)
        drawn.ranges[c].count = instances[c].size() - drawn.ranges[c].first;
}

}  // namespace

InstanceList makeInstances(const asset::AssetView& asset) {
    if (asset.maps.size() > maxMaps)
        throw GlError("more maps than an instance can name");
    InstanceList list;
    listUses(asset, list);
    ByClass byClass;
    for (DrawnMap& drawn : list.drawn)
        addMap(asset, drawn, byClass);
    for (unsigned c = 0; c < costClassCount; ++c) {
        for (DrawnMap& drawn : list.drawn)
            drawn.ranges[c].first += list.instances.size();
        list.instances.insert(list.instances.end(), byClass[c].begin(), byClass[c].end());
    }
    return list;
}

}  // namespace vtm::gl
