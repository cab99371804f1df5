#include "compiler/src/region_paints.hpp"

namespace vtm::compiler {

void RegionPaints::enter(std::vector<scene::FillRule> rules, std::vector<int> corner) {
    rules_ = std::move(rules);
    corner_ = std::move(corner);
    seen_.clear();
    hasLast_ = false;
    toCorner();
}

void RegionPaints::toCorner() {
    windings_ = corner_;
    sum_ = key_ = 0;
    for (std::uint32_t layer = 0; layer < windings_.size(); ++layer) {
        sum_ += static_cast<std::uint64_t>(std::int64_t{windings_[layer]}) * mixed(layer);
        if (isInside(layer))
            key_ ^= mixed(layer);
    }
}

PaintId RegionPaints::paint() {
    if (hasLast_ && lastKey_ == key_)
        return lastPaint_;
    const auto [found, isNew] = seen_.try_emplace(key_, 0);
    if (isNew)
        found->second = compute();
    hasLast_ = true;
    lastKey_ = key_;
    return lastPaint_ = found->second;
}

}  // namespace vtm::compiler
