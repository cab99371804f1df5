#include "conformance/runner/judge/faults.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace vtm::conformance {
namespace {

constexpr std::string_view names[] = {"none",        "flipped-winding", "dropped-piece", "swapped-paint",
                                      "cell-origin", "layers",          "half-distance", "blank",
                                      "shifted",     "recoloured",      "neighbour",     "missing-cell"};

using image::Raster;

/// The leaf with most pieces; nothing if none has any.
asset::Leaf* busiest(asset::Asset& asset) {
    const auto fewer = [](const asset::Leaf& a, const asset::Leaf& b) { return a.pieceCount < b.pieceCount; };
    const auto leaf = std::max_element(asset.leaves.begin(), asset.leaves.end(), fewer);
    return leaf == asset.leaves.end() || leaf->pieceCount == 0 ? nullptr : &*leaf;
}

/// The longest piece of a leaf: what it does is seen best.
asset::Piece& longest(asset::Asset& asset, const asset::Leaf& leaf) {
    const auto length = [](const asset::Piece& p) {
        const double x = double(p.b[0]) - p.a[0], y = double(p.b[1]) - p.a[1];
        return x * x + y * y;
    };
    const auto first = asset.pieces.begin() + leaf.firstPiece;
    return *std::max_element(first, first + leaf.pieceCount,
                             [&](const auto& a, const auto& b) { return length(a) < length(b); });
}

/// The children of the node that holds the busiest leaf, each one place on.
void moveOrigins(asset::Asset& asset) {
    const asset::Leaf* const leaf = busiest(asset);
    const auto isIt = [&](asset::Entry entry) {
        return entry.kind() == asset::Entry::Kind::Leaf && &asset.leaves[entry.payload()] == leaf;
    };
    const auto node = std::ranges::find_if(
        asset.nodes, [&](const asset::Node& n) { return std::ranges::any_of(n.children, isIt); });
    if (node != asset.nodes.end())
        std::rotate(node->children.begin(), node->children.begin() + 1, node->children.end());
    else  // the root itself is the leaf
        for (asset::Map& map : asset.maps)
            map.x += map.side / 16;
}

void swapPaints(asset::Asset& asset) {
    if (asset.paints.size() >= 2)
        std::swap(asset.paints.back(), asset.paints[asset.paints.size() - 2]);
}

Raster shifted(const Raster& picture) {
    Raster result(picture.width, picture.height);
    for (int y = 0; y < picture.height; ++y)
        for (int x = 1; x < picture.width; ++x)
            std::copy_n(picture.pixel(x - 1, y), 4, result.pixel(x, y));
    return result;
}

Raster recoloured(Raster picture) {
    constexpr float less = 5.0f / 255;
    for (float& value : picture.rgba)
        value = std::max(0.0f, value - less);
    return picture;
}

/// The first square of the raster's grid with something in its middle.
Raster withoutCell(Raster picture) {
    constexpr int side = 8;
    for (int y = 0; y + side <= picture.height; y += side)
        for (int x = 0; x + side <= picture.width; x += side)
            if (picture.pixel(x + side / 2, y + side / 2)[3] > 0.5f) {
                for (int row = y; row < y + side; ++row)
                    std::fill_n(picture.pixel(x, row), 4 * side, 0.0f);
                return picture;
            }
    return picture;
}

}  // namespace

const std::vector<Fault>& allFaults() {
    static const std::vector<Fault> all = [] {
        std::vector<Fault> faults;
        for (std::size_t i = 1; i < std::size(names); ++i)
            faults.push_back(Fault(i));
        return faults;
    }();
    return all;
}

std::string_view nameOf(Fault fault) { return names[std::size_t(fault)]; }

Fault faultOf(std::string_view name) {
    const auto found = std::ranges::find(names, name);
    if (found == std::end(names))
        throw std::runtime_error("no fault is called '" + std::string(name) + "'");
    return Fault(found - std::begin(names));
}

asset::Asset damaged(asset::Asset asset, Fault fault) {
    asset::Leaf* const leaf = busiest(asset);
    if (fault == Fault::FlippedWinding && leaf != nullptr) {
        asset::Piece& piece = longest(asset, *leaf);
        std::swap(piece.left, piece.right);
    }
    if (fault == Fault::DroppedPiece && leaf != nullptr) {
        std::swap(longest(asset, *leaf), asset.pieces[leaf->firstPiece + leaf->pieceCount - 1u]);
        --leaf->pieceCount;
    }
    if (fault == Fault::SwappedPaint)
        swapPaints(asset);
    if (fault == Fault::CellOrigin)
        moveOrigins(asset);
    return asset;
}

Raster damaged(const Raster& picture, Fault fault, const Raster& before) {
    switch (fault) {
        case Fault::Blank:
            return {picture.width, picture.height};
        case Fault::Shifted:
            return shifted(picture);
        case Fault::Recoloured:
            return recoloured(picture);
        case Fault::Neighbour:
            return before.width == picture.width && before.height == picture.height ? before : picture;
        case Fault::MissingCell:
            return withoutCell(picture);
        default:
            return picture;
    }
}

}  // namespace vtm::conformance
