/// \file
/// Paints of sets of layers that have been asked for.
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/src/palette.hpp"

namespace vtm::compiler {

/// Paints by 64 well-mixed bits: two sets have the same ones once in 2^64.
class KnownPaints {
public:
    static constexpr PaintId unknown = 0xFFFFFFFFu;

    void clear() {
        slots_.assign(leastSlots, {});
        count_ = 0;
    }

    /// The paint of `key`, which the caller sets if it is `unknown`. Valid until the next call.
    PaintId& operator[](std::uint64_t key) {
        if (2 * count_ >= slots_.size())
            grow();
        Slot& slot = find(key);
        if (slot.paint == unknown) {
            slot.key = key;
            ++count_;
        }
        return slot.paint;
    }

private:
    struct Slot {
        std::uint64_t key = 0;
        PaintId paint = unknown;
    };
    static constexpr std::size_t leastSlots = 64;  ///< a power of two, as all sizes

    Slot& find(std::uint64_t key) {
        std::size_t at = key & (slots_.size() - 1);
        while (slots_[at].paint != unknown && slots_[at].key != key)
            at = (at + 1) & (slots_.size() - 1);
        return slots_[at];
    }

    void grow() {
        std::vector<Slot> old(2 * slots_.size());
        old.swap(slots_);
        for (const Slot& slot : old)
            if (slot.paint != unknown)
                find(slot.key) = slot;
    }

    std::vector<Slot> slots_{leastSlots};
    std::size_t count_ = 0;
};

}  // namespace vtm::compiler
