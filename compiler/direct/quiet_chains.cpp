#include "compiler/direct/quiet_chains.hpp"

#include <algorithm>

namespace vtm::compiler {

void QuietChains::find(std::span<const ReachingChain> chains, std::int32_t base) {
    isQuiet_.assign(chains.size(), 0);
    for (const std::int32_t sign : {1, -1}) {
        lefts_.clear();
        rights_.clear();
        for (const ReachingChain& c : chains)
            if (sign * c.winding > 0)
                rights_.push_back({c.right, sign * c.winding});
            else
                lefts_.push_back({c.left, sign * c.winding});
        add(rights_);
        add(lefts_);
        for (std::size_t i = 0; i < chains.size(); ++i) {
            const ReachingChain& c = chains[i];
            // One that subtracts counts itself among those that may be on its left: so the bound is that on
            // its right, where the number is less.
            isQuiet_[i] |= sign * base + before(rights_, c.left) + upTo(lefts_, c.right) > 0;
        }
    }
    lefts_.clear();
    rights_.clear();
    count_ = 0;
    for (std::size_t i = 0; i < chains.size(); ++i)
        if (isQuiet_[i]) {
            lefts_.push_back({chains[i].left, chains[i].winding});
            rights_.push_back({chains[i].right, chains[i].winding});
            ++count_;
        }
    add(lefts_);
    add(rights_);
}

/// Sorts them and sums their windings.
void QuietChains::add(std::vector<End>& ends) {
    std::ranges::sort(ends, {}, &End::x);
    std::int32_t sum = 0;
    for (End& end : ends)
        end.sum = sum += end.sum;
}

std::int32_t QuietChains::before(const std::vector<End>& ends, float x) {
    const auto next = std::ranges::lower_bound(ends, x, {}, &End::x);
    return next == ends.begin() ? 0 : next[-1].sum;
}

std::int32_t QuietChains::upTo(const std::vector<End>& ends, float x) {
    const auto next = std::ranges::upper_bound(ends, x, {}, &End::x);
    return next == ends.begin() ? 0 : next[-1].sum;
}

std::optional<std::int32_t> QuietChains::windingLeftOf(float x) const {
    const auto begun = std::ranges::upper_bound(lefts_, x, {}, &End::x) - lefts_.begin();
    const auto ended = std::ranges::lower_bound(rights_, x, {}, &End::x) - rights_.begin();
    if (begun > ended)
        return std::nullopt;
    return before(rights_, x);
}

}  // namespace vtm::compiler
