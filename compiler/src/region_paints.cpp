#include "compiler/src/region_paints.hpp"

namespace vtm::compiler {

void RegionPaints::enter(std::span<const scene::FillRule> rules, std::span<const int> corner) {
    rules_.assign(rules.begin(), rules.end());
    corner_.assign(corner.begin(), corner.end());
    few_.clear();
    many_.clear();
    known_ = false;
    toCorner();
}

void RegionPaints::toCorner() {
    windings_.assign(corner_.begin(), corner_.end());
    sum_ = key_ = 0;
    for (std::uint32_t layer = 0; layer < windings_.size(); ++layer) {
        sum_ += static_cast<std::uint64_t>(std::int64_t{windings_[layer]}) * mixed(layer);
        if (isInside(layer))
            key_ ^= mixed(layer);
    }
}

PaintId RegionPaints::paint() {
    if (!known_ || lastKey_ != key_) {
        last_ = find();
        lastKey_ = key_;
        known_ = true;
    }
    return last_;
}

PaintId RegionPaints::find() {
    constexpr std::size_t few = 16;
    for (std::size_t i = few_.size(); i-- > 0;)
        if (few_[i].first == key_)
            return few_[i].second;
    if (few_.size() < few) {
        few_.emplace_back(key_, compute());
        return few_.back().second;
    }
    const auto [found, isNew] = many_.try_emplace(key_, 0);
    if (isNew)
        found->second = compute();
    return found->second;
}

}  // namespace vtm::compiler
