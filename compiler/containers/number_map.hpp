/// \file
/// A hash table for small numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vtm::compiler {

/// Numbers by 64 well-mixed bits of what they stand for, which two things have in common once in 2^64.
class NumberMap {
public:
    static constexpr std::uint32_t unknown = 0xFFFFFFFFu;

    void clear() {
        slots_.assign(minSlots, {});
        count_ = 0;
    }

    std::size_t count() const { return count_; }

    /// That of `key`, which the caller sets if it is `unknown`. Valid until the next call.
    std::uint32_t& operator[](std::uint64_t key) {
        if (2 * count_ >= slots_.size())
            grow();
        Slot& slot = find(key);
        if (slot.number == unknown) {
            slot.key = key;
            ++count_;
        }
        return slot.number;
    }

    /// As it is.
    std::uint32_t at(std::uint64_t key) const { return slots_[place(key)].number; }

private:
    struct Slot {
        std::uint64_t key = 0;
        std::uint32_t number = unknown;
    };
    static constexpr std::size_t minSlots = 64;  ///< a power of two, as all sizes

    std::size_t place(std::uint64_t key) const {
        std::size_t at = key & (slots_.size() - 1);
        while (slots_[at].number != unknown && slots_[at].key != key)
            at = (at + 1) & (slots_.size() - 1);
        return at;
    }
    Slot& find(std::uint64_t key) { return slots_[place(key)]; }

    void grow() {
        std::vector<Slot> old(2 * slots_.size());
        old.swap(slots_);
        for (const Slot& slot : old)
            if (slot.number != unknown)
                find(slot.key) = slot;
    }

    std::vector<Slot> slots_{minSlots};
    std::size_t count_ = 0;
};

}  // namespace vtm::compiler
