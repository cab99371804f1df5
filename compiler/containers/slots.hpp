/// \file
/// A hash table of places in a list, for a few hundred of them at a time.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vtm::compiler {

/// Finds things that stand in a list of the caller's by what makes them equal.
class Slots {
public:
    static constexpr std::uint32_t noIndex = 0xFFFFFFFFu;

    /// Forgets all; makes room for `count`.
    void reset(std::size_t count) {
        const std::size_t size = std::bit_ceil(2 * count + 1);
        places_.assign(size, noIndex);
        shift_ = 64 - static_cast<unsigned>(std::countr_zero(size));
    }

    /// The place in the list for which `isEqual` is true, or `noIndex`, which the caller sets. Equal things
    /// have equal keys.
    template <class IsEqual>
    std::uint32_t& find(std::uint64_t key, const IsEqual& isEqual) {
        constexpr std::uint64_t golden = 0x9E3779B97F4A7C15u;  // Fibonacci hashing (Knuth, TAOCP 3, 6.4)
        std::size_t slot = key * golden >> shift_;
        while (places_[slot] != noIndex && !isEqual(places_[slot]))
            slot = (slot + 1) & (places_.size() - 1);
        return places_[slot];
    }

private:
    std::vector<std::uint32_t> places_;
    unsigned shift_ = 0;
};

}  // namespace vtm::compiler
