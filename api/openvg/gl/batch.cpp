#include "api/openvg/gl/batch.hpp"

#include <algorithm>
#include <cstring>

namespace vtm::openvg::gl {

namespace {

constexpr std::size_t maxInstances = 1 << 15, maxShares = 1 << 20, maxRamps = 64, maxDraws = 1024;

}  // namespace

bool Batch::isFull() const {
    return instances.size() >= maxInstances || shareCount >= maxShares || ramps.size() >= maxRamps ||
           draws.size() >= maxDraws;
}

bool Batch::joins(const Draw& last, const Draw& draw) const {
    // What copies parts of its target must see what was copied before.
    if (draw.texels[0] == draw.target || last.target != draw.target || last.key != draw.key ||
        last.texels[0] != draw.texels[0] || last.texels[1] != draw.texels[1] || last.mask != draw.mask ||
        last.readsTarget != draw.readsTarget ||
        std::memcmp(&last.block, &draw.block, sizeof(LayerBlock)) != 0)
        return false;
    return canFetch_ || !draw.readsTarget || std::ranges::none_of(last.read, [&](const Rectangle& part) {
               return !part.intersected(draw.read.front()).empty();
           });
}

void Batch::add(Draw draw, Tiles tiles, Color color, const RampRow* ramp) {
    if (draw.read.empty())
        draw.read.push_back(tiles.box);
    if (ramp) {
        if (ramps.empty() || ramps.back() != *ramp)
            ramps.push_back(*ramp);
        draw.block.ramp.x = int(ramps.size() - 1);
    }
    const std::size_t shift = shareCount;
    if (!tiles.shares.empty()) {
        shareCount += tiles.shares.size();
        shares.push_back(std::move(tiles.shares));
    }
    draw.first = instances.size();
    draw.count = tiles.tiles.size();
    for (Tile tile : tiles.tiles) {
        if (tile.shares != Tile::allCovered)
            tile.shares += std::uint32_t(shift);
        instances.push_back({tile, color});
    }
    if (!draws.empty() && joins(draws.back(), draw)) {
        draws.back().count += draw.count;
        draws.back().read.push_back(tiles.box);
    } else {
        draws.push_back(std::move(draw));
    }
}

}  // namespace vtm::openvg::gl
