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

Tiles oneTile(const Rectangle& box) {
    Tiles tiles;
    tiles.box = box;
    if (!box.empty())
        tiles.tiles.push_back({std::uint16_t(box.x0), std::uint16_t(box.y0), std::uint16_t(box.x1 - box.x0),
                               std::uint16_t(box.y1 - box.y0), Tile::allCovered});
    return tiles;
}

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

void TileBuilder::findKinds(std::span<const Run> runs, int rows) {
    const auto columns = std::size_t((box_.x1 - box_.x0 + tileSide - 1) / tileSide);
    covered_.assign(columns + 1, 0);
    touched_.assign(columns + 1, 0);
    const auto count = [](std::vector<int>& differences, int first, int end) {
        if (first < end) {
            ++differences[std::size_t(first)];
            --differences[std::size_t(end)];
        }
    };
    for (const Run& run : runs) {
        const int first = run.first - box_.x0, end = run.end - box_.x0;
        count(touched_, first / tileSide, (end + tileSide - 1) / tileSide);
        // The last column may be narrower.
        if (run.share == 1)
            count(covered_, (first + tileSide - 1) / tileSide,
                  run.end == box_.x1 ? int(columns) : end / tileSide);
    }
    kinds_.resize(columns);
    for (std::size_t i = 0, covered = 0, touched = 0; i < columns; ++i) {
        covered += std::size_t(covered_[i]);
        touched += std::size_t(touched_[i]);
        kinds_[i] = covered == std::size_t(rows) ? Kind::all : touched > 0 ? Kind::partly : Kind::empty;
    }
}

void TileBuilder::addBand(Tiles& tiles, std::span<const Run> runs, int y0, int y1) {
    findKinds(runs, y1 - y0);
    opened_.clear();
    blocks_.clear();
    for (std::size_t i = 0; i < kinds_.size();) {
        std::size_t end = i + 1;
        while (end < kinds_.size() && kinds_[end] == kinds_[i])
            ++end;
        const int x0 = box_.x0 + int(i) * tileSide, x1 = std::min(box_.x0 + int(end) * tileSide, box_.x1);
        if (kinds_[i] == Kind::all)
            addCovered(tiles, x0, x1, y0, y1);
        else if (kinds_[i] == Kind::partly)
            addBlock(tiles, x0, x1, y0, y1);
        i = end;
    }
    fillBlocks(tiles, runs, y0);
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

void TileBuilder::addBlock(Tiles& tiles, int x0, int x1, int y0, int y1) {
    const int width = x1 - x0, height = y1 - y0;
    const std::size_t start = tiles.shares.size();
    tiles.shares.resize(start + std::size_t(width) * std::size_t(height), 0.0f);
    blocks_.push_back({x0, x1, start});
    // The shares of a tile just below end where these begin.
    if (!tiles.tiles.empty()) {
        Tile& last = tiles.tiles.back();
        if (last.shares != Tile::allCovered && last.x == x0 && last.width == width &&
            last.y + last.height == y0 && tiles.shares.size() - last.shares <= maxBlock) {
            last.height = std::uint16_t(last.height + height);
            return;
        }
    }
    tiles.tiles.push_back({std::uint16_t(x0), std::uint16_t(y0), std::uint16_t(width), std::uint16_t(height),
                           std::uint32_t(start)});
}

void TileBuilder::fillBlocks(Tiles& tiles, std::span<const Run> runs, int y0) const {
    std::size_t k = 0;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const Run& run = runs[i];
        // Within a row runs mostly go to the right.
        if (i > 0 && (run.y != runs[i - 1].y || run.first < runs[i - 1].first))
            k = 0;
        while (k < blocks_.size() && blocks_[k].x1 <= run.first)
            ++k;
        for (std::size_t j = k; j < blocks_.size() && blocks_[j].x0 < run.end; ++j) {
            const Block& block = blocks_[j];
            const int first = std::max(run.first, block.x0), end = std::min(run.end, block.x1);
            const std::ptrdiff_t row = std::ptrdiff_t(run.y - y0) * (block.x1 - block.x0);
            std::fill_n(tiles.shares.begin() + std::ptrdiff_t(block.shares) + row + (first - block.x0),
                        end - first, run.share);
        }
    }
}

}  // namespace vtm::openvg::gl
