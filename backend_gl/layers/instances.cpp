#include "backend_gl/layers/instances.hpp"

#include <algorithm>

#include <glm/common.hpp>

#include "asset/walk.hpp"

namespace vtm::gl {

namespace {

using asset::Cell;
using asset::Entry;
using Command = asset::Command;

bool isEmpty(Entry entry) { return entry.kind() == Entry::Kind::Solid && entry.payload() == 0; }

LeafProgram programOf(Entry entry) {
    return entry.kind() == Entry::Kind::Solid ? LeafProgram::Solid : LeafProgram::Pieces;
}

/// The masks that the commands draw, each once, in order of first use.
void listMasks(const asset::AssetView& asset, InstanceList& list) {
    list.drawnOfMap.resize(asset.maps.size());
    for (const Command& command : asset.commands) {
        if (command.kind != Command::Kind::FillMask && command.kind != Command::Kind::ClipMask)
            continue;
        auto& drawn = list.drawnOfMap[command.map];
        if (drawn)
            continue;
        drawn = std::uint32_t(list.drawn.size());
        list.drawn.push_back({command.map, {}, glm::uvec2(~0u), glm::uvec2(0)});
    }
}

void grow(DrawnMask& drawn, Cell cell) {
    const std::uint32_t units = 1u << (2 * (asset::maxLevel - cell.level));
    drawn.min = glm::min(drawn.min, glm::uvec2(cell.x, cell.y) * units);
    drawn.max = glm::max(drawn.max, glm::uvec2(cell.x + 1, cell.y + 1) * units);
}

using ByProgram = std::array<std::vector<Instance>, leafProgramCount>;

void addMask(const asset::AssetView& asset, DrawnMask& drawn, ByProgram& instances) {
    for (unsigned p = 0; p < leafProgramCount; ++p)
        drawn.ranges[p].first = instances[p].size();
    asset::walk(asset, asset.maps[drawn.map].root, [&](Cell cell, Entry entry) {
        if (isEmpty(entry))
            return;
        grow(drawn, cell);
        instances[unsigned(programOf(entry))].push_back(
            {cell.x, cell.y, cell.level | drawn.map << 4, entry.bits});
    });
    for (unsigned p = 0; p < leafProgramCount; ++p)
        drawn.ranges[p].count = instances[p].size() - drawn.ranges[p].first;
}

}  // namespace

InstanceList makeInstances(const asset::AssetView& asset) {
    if (asset.maps.size() > maxMaps)
        throw GlError("the asset has more maps than an instance can refer to");
    InstanceList list;
    listMasks(asset, list);
    ByProgram byProgram;
    for (DrawnMask& drawn : list.drawn)
        addMask(asset, drawn, byProgram);
    for (unsigned p = 0; p < leafProgramCount; ++p) {
        for (DrawnMask& drawn : list.drawn)
            drawn.ranges[p].first += list.instances.size();
        list.instances.insert(list.instances.end(), byProgram[p].begin(), byProgram[p].end());
    }
    return list;
}

}  // namespace vtm::gl
