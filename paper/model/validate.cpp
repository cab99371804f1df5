// What a paper-mode asset must satisfy before it is evaluated or uploaded, and its figures.

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include <vtm/asset/container.hpp>
#include "asset/src/validate.hpp"
#include "paper/model.hpp"

namespace vtm::paper {

namespace {

using asset::Entry;

void require(bool holds, const std::string& what) {
    if (!holds)
        throw asset::FormatError("paper asset: " + what);
}

std::size_t mipTexels(unsigned sizeLog2) {
    std::size_t texels = 0;
    for (unsigned k = 0; k <= sizeLog2; ++k)
        texels += std::size_t(1) << (2 * k);
    return texels;
}

/// A node's children stand after `parent`; the root's parent is -1.
void checkEntry(const Mask& mask, Entry entry, std::ptrdiff_t parent, const std::string& where) {
    const std::uint32_t payload = entry.payload();
    switch (entry.kind()) {
        case Entry::Kind::Solid:
            return require(payload <= 1, where + ": a solid must be 0 or 1");
        case Entry::Kind::Leaf:
            return require(payload < mask.cells.size(), where + ": no such cell");
        case Entry::Kind::Node:
            return require(payload < mask.nodes.size() && std::ptrdiff_t(payload) > parent,
                           where + ": no such node below");
        case Entry::Kind::Instances:
            break;
    }
    require(false, where + ": unknown kind of entry");
}

void checkCell(const Cell& cell, const std::string& where) {
    require(cell.count == 1 || cell.count == 2, where + ": must have one or two pieces");
    for (unsigned i = 0; i < cell.count; ++i)
        require(cell.pieces[i].a != cell.pieces[i].b, where + ": a piece has no length");
}

void checkMask(const Mask& mask, const std::string& where) {
    require(std::abs(mask.x) <= asset::largestLength && std::abs(mask.y) <= asset::largestLength &&
                mask.side <= asset::largestLength && mask.side >= 1 / asset::largestLength,
            where + ": its square is beyond the limits");
    checkEntry(mask, mask.root, -1, where);
    for (std::size_t n = 0; n < mask.nodes.size(); ++n)
        for (const Entry child : mask.nodes[n].children)
            checkEntry(mask, child, std::ptrdiff_t(n), fmt::format("{}, node {}", where, n));
    for (std::size_t c = 0; c < mask.cells.size(); ++c)
        checkCell(mask.cells[c], fmt::format("{}, cell {}", where, c));
    require(mask.mip.sizeLog2 <= 12 && mask.mip.texels.size() == mipTexels(mask.mip.sizeLog2),
            where + ": the mip has the wrong size");
}

void checkSide(const Asset& asset, const Side& side, std::size_t node, const std::string& where) {
    require(side.paint < asset.palette.paints.size(), where + ": no such paint");
    require(side.rest == noIndex || side.rest < node, where + ": its rest is not an earlier node");
}

void checkNode(const Asset& asset, std::size_t index) {
    const Node& node = asset.nodes[index];
    const std::string where = fmt::format("node {}", index);
    require(node.mask == noIndex || node.mask < asset.masks.size(), where + ": no such mask");
    require(node.opacity >= 0 && node.opacity <= 1, where + ": its opacity is not in [0, 1]");
    require(!node.bounds || node.mask == noIndex, where + ": it has a mask beside its bounds");
    checkSide(asset, node.inside, index, where);
    checkSide(asset, node.outside, index, where);
}

/// As if every side were taken everywhere: no pixel lets more nodes wait.
void checkPending(const Asset& asset) {
    std::set<std::uint32_t> pending;
    if (asset.root != noIndex)
        pending.insert(asset.root);
    while (!pending.empty()) {
        require(pending.size() <= maxPending, fmt::format("more than {} nodes are pending", maxPending));
        const Node& node = asset.nodes[*pending.rbegin()];
        pending.erase(std::prev(pending.end()));
        for (const Side* side : {&node.inside, &node.outside})
            if (side->rest != noIndex)
                pending.insert(side->rest);
    }
}

/// Levels of the tree above its deepest cell; a node's children stand after it.
unsigned depthOf(const Mask& mask) {
    std::vector<unsigned> level(mask.nodes.size());
    unsigned depth = 0;
    for (std::size_t n = 0; n < mask.nodes.size(); ++n)
        for (const Entry child : mask.nodes[n].children) {
            if (child.kind() == Entry::Kind::Node)
                level[child.payload()] = std::max(level[child.payload()], level[n] + 1);
            depth = std::max(depth, level[n] + 1);
        }
    return depth;
}

}  // namespace

void validate(const Asset& asset) {
    asset::validatePaints(asset.palette);
    for (std::size_t i = 0; i < asset.masks.size(); ++i)
        checkMask(asset.masks[i], fmt::format("mask {}", i));
    for (std::size_t i = 0; i < asset.nodes.size(); ++i)
        checkNode(asset, i);
    require(asset.root == noIndex || asset.root < asset.nodes.size(), "no such root");
    checkPending(asset);
}

Summary summarize(const Asset& asset) {
    constexpr std::size_t maskTexels = 2, nodeTexels = 2, treeNodeTexels = 4, cellTexels = 2;
    Summary s;
    s.masks = asset.masks.size();
    s.nodes = asset.nodes.size();
    for (const Mask& mask : asset.masks) {
        s.indirections += mask.nodes.size();
        s.cells += mask.cells.size();
        s.mipBytes += mask.mip.texels.size();
        s.gridBytes += (sizeof(asset::Texel) * cellTexels) << (4 * depthOf(mask));
        for (const Cell& cell : mask.cells)
            s.pieces += cell.count;
    }
    s.treeBytes = sizeof(asset::Texel) * (treeNodeTexels * s.indirections + cellTexels * s.cells);
    s.bytes = s.mipBytes + s.treeBytes + sizeof(asset::Texel) * (maskTexels * s.masks + nodeTexels * s.nodes);
    return s;
}

}  // namespace vtm::paper
