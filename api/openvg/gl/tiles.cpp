#include "api/openvg/gl/tiles.hpp"

#include <algorithm>

namespace vtm::openvg::gl {

namespace {

constexpr int tileSide = 16;
/// Of a block that grows upwards.
constexpr std::size_t maxBlock = 1 << 16;

Rectangle boxOf(const Tile& tile) { return {tile.x, tile.y, tile.x + tile.width, tile.y + tile.height}; }

void grow(Rectangle& box, const Rectangle& by) {
    box = box.empty() ? by
                      : Rectangle{std::min(box.x0, by.x0), std::min(box.y0, by.y0), std::max(box.x1, by.x1),
                                  std::max(box.y1, by.y1)};
}

}  // namespace

std::vector<Tiles> inParts(Tiles tiles, std::size_t shares) {
    std::vector<Tiles> parts;
    if (tiles.shares.size() <= shares) {
        parts.push_back(std::move(tiles));
        return parts;
    }
    for (Tile tile : tiles.tiles) {
        if (parts.empty() || parts.back().shares.size() >= shares)
            parts.emplace_back();
        Tiles& part = parts.back();
        grow(part.box, boxOf(tile));
        if (tile.shares != Tile::allCovered) {
            const auto from = tiles.shares.begin() + std::ptrdiff_t(tile.shares);
            tile.shares = std::uint32_t(part.shares.size());
            part.shares.insert(part.shares.end(), from,
                               from + std::ptrdiff_t(tile.width) * std::ptrdiff_t(tile.height));
        }
        part.tiles.push_back(tile);
    }
    return parts;
}

void TileBuilder::add(int y, int first, int end, float share) {
    if (runs_.empty())
        box_ = {};
    grow(box_, {first, y, end, y + 1});
    if (!runs_.empty() && runs_.back().y == y && runs_.back().end == first && runs_.back().share == share)
        runs_.back().end = end;
    else
        runs_.push_back({y, first, end, share});
}

Tiles TileBuilder::finish() {
    Tiles tiles;
    tiles.box = box_;
    if (!std::ranges::is_sorted(runs_, {}, &Run::y))
        std::ranges::stable_sort(runs_, {}, &Run::y);
    open_.clear();
    for (std::size_t first = 0; first < runs_.size();) {
        const int y0 = box_.y0 + (runs_[first].y - box_.y0) / tileSide * tileSide;
        std::size_t end = first;
        while (end < runs_.size() && runs_[end].y < y0 + tileSide)
            ++end;
        addBand(tiles, std::span(runs_).subspan(first, end - first), y0, std::min(y0 + tileSide, box_.y1));
        first = end;
    }
    runs_.clear();
    return tiles;
}

std::vector<TileBuilder::Kind> TileBuilder::kindsOf(std::span<const Run> runs, int rows) const {
    const int columns = (box_.x1 - box_.x0 + tileSide - 1) / tileSide;
    std::vector<int> covered(std::size_t(columns), 0);  ///< rows
    std::vector<Kind> kinds(std::size_t(columns), Kind::empty);
    for (const Run& run : runs)
        for (int i = (run.first - box_.x0) / tileSide; i <= (run.end - 1 - box_.x0) / tileSide; ++i) {
            const int x0 = box_.x0 + i * tileSide, x1 = std::min(x0 + tileSide, box_.x1);
            kinds[std::size_t(i)] = Kind::partly;
            covered[std::size_t(i)] += run.share == 1 && run.first <= x0 && run.end >= x1;
        }
    for (std::size_t i = 0; i < kinds.size(); ++i)
        if (covered[i] == rows)
            kinds[i] = Kind::all;
    return kinds;
}

void TileBuilder::addBand(Tiles& tiles, std::span<const Run> runs, int y0, int y1) {
    const std::vector<Kind> kinds = kindsOf(runs, y1 - y0);
    opened_.clear();
    for (std::size_t i = 0; i < kinds.size();) {
        std::size_t end = i + 1;
        while (end < kinds.size() && kinds[end] == kinds[i])
            ++end;
        const int x0 = box_.x0 + int(i) * tileSide, x1 = std::min(box_.x0 + int(end) * tileSide, box_.x1);
        if (kinds[i] == Kind::all)
            addCovered(tiles, x0, x1, y0, y1);
        else if (kinds[i] == Kind::partly)
            addShares(tiles, runs, {x0, y0, x1, y1});
        i = end;
    }
    std::swap(open_, opened_);
}

void TileBuilder::addCovered(Tiles& tiles, int x0, int x1, int y0, int y1) {
    for (const std::size_t i : open_) {
        Tile& below = tiles.tiles[i];
        if (below.x == x0 && below.x + below.width == x1 && below.y + below.height == y0) {
            below.height = std::uint16_t(below.height + y1 - y0);
            opened_.push_back(i);
            return;
        }
    }
    opened_.push_back(tiles.tiles.size());
    tiles.tiles.push_back({std::uint16_t(x0), std::uint16_t(y0), std::uint16_t(x1 - x0),
                           std::uint16_t(y1 - y0), Tile::allCovered});
}

void TileBuilder::addShares(Tiles& tiles, std::span<const Run> runs, const Rectangle& block) {
    const int width = block.x1 - block.x0, height = block.y1 - block.y0;
    const std::size_t start = tiles.shares.size();
    tiles.shares.resize(start + std::size_t(width) * std::size_t(height), 0.0f);
    for (const Run& run : runs) {
        const int first = std::max(run.first, block.x0), end = std::min(run.end, block.x1);
        if (first < end)
            std::fill_n(tiles.shares.begin() + std::ptrdiff_t(start) +
                            std::ptrdiff_t(run.y - block.y0) * width + (first - block.x0),
                        end - first, run.share);
    }
    // The shares of a tile just below end where these begin.
    if (!tiles.tiles.empty()) {
        Tile& last = tiles.tiles.back();
        if (last.shares != Tile::allCovered && last.x == block.x0 && last.width == width &&
            last.y + last.height == block.y0 && tiles.shares.size() - last.shares <= maxBlock) {
            last.height = std::uint16_t(last.height + height);
            return;
        }
    }
    tiles.tiles.push_back({std::uint16_t(block.x0), std::uint16_t(block.y0), std::uint16_t(width),
                           std::uint16_t(height), std::uint32_t(start)});
}

}  // namespace vtm::openvg::gl
