/// \file
/// Values in the order of their keys, in blocks: neighbours lie next to each other in memory.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

namespace vtm::compiler {

/// As std::multimap<double, Value>, for walks to neighbours.
template <class Value>
class SortedBlocks {
public:
    struct Entry {
        double key;
        Value value;
    };
    /// An entry, or the end. Valid until the next insert().
    struct Place {
        std::size_t block = 0, entry = 0;
        bool operator==(const Place&) const = default;
    };

    Place begin() const { return {}; }
    Place end() const { return {blocks_.size(), 0}; }
    const Entry& operator[](Place place) const { return blocks_[place.block][place.entry]; }
    Place next(Place place) const {
        return place.entry + 1 < blocks_[place.block].size() ? Place{place.block, place.entry + 1}
                                                             : Place{place.block + 1, 0};
    }
    Place before(Place place) const {
        return place.entry > 0 ? Place{place.block, place.entry - 1}
                               : Place{place.block - 1, blocks_[place.block - 1].size() - 1};
    }

    /// The first entry whose key is not less.
    Place lowerBound(double key) const {
        const auto block = std::ranges::lower_bound(blocks_, key, {}, lastKey);
        if (block == blocks_.end())
            return end();
        const auto entry = std::ranges::lower_bound(*block, key, {}, &Entry::key);
        return {std::size_t(block - blocks_.begin()), std::size_t(entry - block->begin())};
    }

    /// Behind those of the same key.
    void insert(double key, const Value& value) {
        if (blocks_.empty())
            blocks_.emplace_back();
        auto block = std::ranges::upper_bound(blocks_.begin(), std::prev(blocks_.end()), key, {}, lastKey);
        block->insert(std::ranges::upper_bound(*block, key, {}, &Entry::key), {key, value});
        if (block->size() <= maxEntries)
            return;
        const auto middle = block->begin() + std::ptrdiff_t(maxEntries / 2);
        Block upper(middle, block->end());
        block->erase(middle, block->end());
        blocks_.insert(std::next(block), std::move(upper));
    }

private:
    using Block = std::vector<Entry>;
    static constexpr std::size_t maxEntries = 512;

    static double lastKey(const Block& block) { return block.back().key; }

    std::vector<Block> blocks_;  ///< none is empty but the only one
};

}  // namespace vtm::compiler
