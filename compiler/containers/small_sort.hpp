/// \file
/// Sorting a few things without branches, whose outcome would be random.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vtm::compiler {

/// Sorts by `key`, a 64-bit number that `keyOf` gives; what is equal keeps its order. `spare` is workspace.
template <class T, class KeyOf>
void sortByKey(std::vector<T>& items, std::vector<T>& spare, const KeyOf& keyOf) {
    constexpr std::size_t few = 64;  // beyond, the number of pairs costs more than wrong guesses
    const std::size_t count = items.size();
    if (count < 2)
        return;
    if (count > few) {
        std::stable_sort(items.begin(), items.end(),
                         [&](const T& p, const T& q) { return keyOf(p) < keyOf(q); });
        return;
    }
    std::array<std::uint64_t, few> keys;
    std::array<std::uint32_t, few> rank;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint64_t key = keyOf(items[i]);
        std::uint32_t below = 0;
        for (std::size_t j = 0; j < i; ++j) {
            const std::uint32_t isBelow = keys[j] <= key;
            below += isBelow;
            rank[j] += 1 - isBelow;
        }
        keys[i] = key;
        rank[i] = below;
    }
    spare.resize(count);
    for (std::size_t i = 0; i < count; ++i)
        spare[rank[i]] = items[i];
    items.swap(spare);
}

/// Puts one thing after the other into its place; what is equal keeps its order.
template <class Iterator, class IsBefore>
void insertEach(Iterator first, Iterator last, const IsBefore& isBefore) {
    for (Iterator next = first; next != last; ++next) {
        const auto item = *next;
        Iterator at = next;
        for (; at != first && isBefore(item, at[-1]); --at)
            *at = at[-1];
        *at = item;
    }
}

inline constexpr std::ptrdiff_t fewToInsert = 16;

/// Sorts a few things by `isBefore`, in place.
template <class Iterator, class IsBefore>
void sortFew(Iterator first, Iterator last, const IsBefore& isBefore) {
    if (last - first > fewToInsert)
        std::sort(first, last, isBefore);
    else
        insertEach(first, last, isBefore);
}

/// As std::stable_sort, which asks for memory.
template <class Iterator, class IsBefore>
void sortStably(Iterator first, Iterator last, const IsBefore& isBefore) {
    if (last - first > fewToInsert)
        std::stable_sort(first, last, isBefore);
    else
        insertEach(first, last, isBefore);
}

}  // namespace vtm::compiler
