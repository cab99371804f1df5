#include "paper/gl/texels.hpp"

#include <bit>

namespace vtm::paper {

namespace {

using asset::Texel;

std::uint32_t bits(double v) { return std::bit_cast<std::uint32_t>(float(v)); }

std::uint32_t pair(std::uint16_t low, std::uint16_t high) { return low | std::uint32_t(high) << 16; }

Texel pieceTexel(const Piece& p, std::uint32_t tag) {
    return {pair(p.a[0], p.a[1]), pair(p.b[0], p.b[1]),
            pair(std::uint16_t(p.slopeA), std::uint16_t(p.slopeB)), tag};
}

void appendCell(const Cell& cell, std::vector<Texel>& data) {
    const std::uint32_t tag = cell.count == 1 ? 0 : 1 + std::uint32_t(cell.combine);
    data.push_back(pieceTexel(cell.pieces[0], tag));
    data.push_back(pieceTexel(cell.pieces[1], 0));
}

void appendTreeNode(const asset::Node& node, std::vector<Texel>& data) {
    for (std::size_t row = 0; row < 4; ++row) {
        Texel texel;
        for (std::size_t column = 0; column < 4; ++column)
            texel[column] = node.children[4 * row + column].bits;
        data.push_back(texel);
    }
}

void appendMip(const Mip& mip, std::vector<Texel>& data) {
    const std::size_t first = data.size();
    data.resize(first + (mip.texels.size() + 15) / 16);
    for (std::size_t i = 0; i < mip.texels.size(); ++i)
        data[first + i / 16][i / 4 % 4] |= std::uint32_t(mip.texels[i]) << (8 * (i % 4));
}

/// The two texels of a mask at `header`, its content at the end.
void appendMask(const Mask& mask, std::size_t header, std::vector<Texel>& data) {
    const auto end = [&] { return std::uint32_t(data.size()); };
    data[header] = {bits(mask.x), bits(mask.y), bits(mask.side), mask.root.bits};
    Texel places{end(), 0, 0, mask.mip.sizeLog2};
    for (const asset::Node& node : mask.nodes)
        appendTreeNode(node, data);
    places[1] = end();
    for (const Cell& cell : mask.cells)
        appendCell(cell, data);
    places[2] = end();
    appendMip(mask.mip, data);
    data[header + 1] = places;
}

std::uint32_t paintOf(const Side& side) { return side.discard ? noIndex : side.paint; }

}  // namespace

Sections appendTexels(const Asset& asset, std::vector<Texel>& data) {
    Sections sections;
    sections.nodes = std::uint32_t(data.size());
    for (const Node& n : asset.nodes) {
        const Bounds bounds = n.bounds.value_or(Bounds());
        const auto corner = [](const std::array<std::uint16_t, 2>& c) {
            return c[0] | std::uint32_t(c[1]) << 16;
        };
        data.push_back({n.bounds ? hasBounds : n.mask, std::bit_cast<std::uint32_t>(n.opacity),
                        paintOf(n.inside), n.inside.rest});
        data.push_back({corner(bounds.min), corner(bounds.max), paintOf(n.outside), n.outside.rest});
    }
    sections.masks = std::uint32_t(data.size());
    data.resize(data.size() + 2 * asset.masks.size());
    for (std::size_t i = 0; i < asset.masks.size(); ++i)
        appendMask(asset.masks[i], sections.masks + 2 * i, data);
    return sections;
}

}  // namespace vtm::paper
