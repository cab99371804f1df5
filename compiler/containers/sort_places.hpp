/// \file
/// Sorting many things by where they are.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace vtm::compiler {

/// A thing, by number, and where it is: no NaN.
struct Placed {
    float x;
    std::uint32_t number;
};

namespace detail {

/// Grows with x.
inline std::uint32_t keyOf(float x) {
    const auto bits = std::bit_cast<std::uint32_t>(x + 0.0f);  // -0 is 0
    return bits ^ ((bits >> 31) != 0 ? 0xFFFFFFFFu : 0x80000000u);
}

/// By digits of the key, from the lowest one on.
inline void sortByDigits(std::vector<Placed>& places, std::vector<Placed>& spare) {
    constexpr unsigned bits = 11, digits = 3;
    constexpr std::uint32_t mask = (1u << bits) - 1;
    std::array<std::array<std::uint32_t, 1u << bits>, digits> firsts{};
    for (const Placed& p : places)
        for (unsigned d = 0; d < digits; ++d)
            ++firsts[d][keyOf(p.x) >> d * bits & mask];
    spare.resize(places.size());
    for (unsigned d = 0; d < digits; ++d) {
        std::uint32_t first = 0;
        for (std::uint32_t& f : firsts[d])
            first += std::exchange(f, first);
        for (const Placed& p : places)
            spare[firsts[d][keyOf(p.x) >> d * bits & mask]++] = p;
        places.swap(spare);
    }
}

/// False if they are far from sorted; then they are in some order.
inline bool sortNearly(std::vector<Placed>& places) {
    constexpr std::size_t manyMoves = 4;
    std::size_t moves = 0;
    for (std::size_t i = 1; i < places.size(); ++i) {
        if (!(places[i].x < places[i - 1].x))
            continue;
        const Placed place = places[i];
        std::size_t to = i;
        do {
            places[to] = places[to - 1];
            --to;
        } while (to > 0 && place.x < places[to - 1].x);
        places[to] = place;
        moves += i - to;
        if (moves > manyMoves * places.size())
            return false;
    }
    return true;
}

}  // namespace detail

/// From left to right; what is nearly sorted takes little.
inline void sortPlaces(std::vector<Placed>& places, std::vector<Placed>& spare) {
    constexpr std::size_t few = 1024;  // digits have twice as many values
    const auto isBefore = [](const Placed& a, const Placed& b) { return a.x < b.x; };
    if (detail::sortNearly(places))
        return;
    if (places.size() < few)
        std::stable_sort(places.begin(), places.end(), isBefore);
    else
        detail::sortByDigits(places, spare);
}

}  // namespace vtm::compiler
