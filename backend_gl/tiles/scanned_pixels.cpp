#include "backend_gl/tiles/scanned_pixels.hpp"

#include <algorithm>

#include <glm/common.hpp>

#include "backend_gl/core/turns.hpp"

namespace vtm::gl {

namespace {

using asset::Command;

template <class Item>
void copy(std::span<const Item> from, std::vector<Item>& to) {
    to.assign(from.begin(), from.end());
}

/// With the map as its only one.
asset::AssetView onlyMap(const asset::Asset& asset, const asset::Map& map, const Command& command) {
    asset::AssetView view = asset;
    view.maps = {&map, 1};
    view.commands = {&command, 1};
    return view;
}

}  // namespace

KeptAsset keptOf(const asset::AssetView& asset) {
    KeptAsset kept;
    copy(asset.nodes, kept.asset.nodes);
    copy(asset.leaves, kept.asset.leaves);
    copy(asset.pieces, kept.asset.pieces);
    copy(asset.paints, kept.asset.paints);
    copy(asset.data, kept.asset.data);
    copy(asset.images, kept.asset.images);
    copy(asset.materials, kept.asset.materials);
    kept.programTurns = programTurns(asset);
    kept.changes = asset::changesOf(asset);
    return kept;
}

const asset::Scanner& ScannedPixels::scannerFor(asset::Sums sums) {
    std::optional<asset::Scanner>& scanner = scanners_[std::size_t(sums)];
    if (!scanner) {
        const Command command;
        scanner.emplace(onlyMap(*asset_, map_, command), sums);
    }
    return *scanner;
}

void ScannedPixels::scan(const asset::View& view, const PixelBox& box, asset::Sums sums) {
    const glm::ivec2 size = box.size();
    const asset::View part{
        size.x, size.y, {view.toPixels[0], view.toPixels[1], view.toPixels[2] - glm::dvec2(box.min)}};
    std::vector<glm::vec4> pixels(std::size_t(size.x) * std::size_t(size.y));
    scannerFor(sums).scan(part, [&](int y, const asset::ColorRun& run) {
        glm::vec4* const row = pixels.data() + std::size_t(y) * std::size_t(size.x);
        std::fill(row + run.first, row + run.end, run.color);
    });
    if (texture_.get() == 0 || size.x > size_.x || size.y > size_.y) {
        size_ = glm::max(size_, size);
        texture_ = makeTexture(GL_RGBA32F, size_.x, size_.y);
    }
    glBindTexture(GL_TEXTURE_2D, texture_.get());
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size.x, size.y, GL_RGBA, GL_FLOAT, pixels.data());
    checkErrors("scanned pixels");
}

}  // namespace vtm::gl
