/// \file
/// Where one stands in a leaf: the winding numbers of its layers, and the paint that they make.
#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "compiler/src/palette.hpp"
#include "scene/path.hpp"

namespace vtm::compiler {

/// 64 well-mixed bits (SplitMix64): sums and exclusive ors of them vanish by chance once in 2^64.
inline std::uint64_t mixed(std::uint64_t value) {
    std::uint64_t z = (value + 1) * 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

/// Walks from region to region. The paint of each set of layers is asked for once.
class RegionPaints {
public:
    virtual ~RegionPaints() = default;

    /// Enters a leaf: its layers' rules, and their windings at its first corner.
    void enter(std::span<const scene::FillRule> rules, std::span<const int> corner);
    /// Goes to the first corner.
    void toCorner();
    /// Crosses an edge of a layer.
    void change(std::uint32_t layer, int winding) {
        const bool before = isInside(layer);
        windings_[layer] += winding;
        sum_ += static_cast<std::uint64_t>(std::int64_t{winding}) * mixed(layer);
        if (isInside(layer) != before)
            key_ ^= mixed(layer);
    }
    /// The paint of the region.
    PaintId paint();
    /// Equal places have equal sums of their windings.
    std::uint64_t windingSum() const { return sum_; }
    bool isInside(std::uint32_t layer) const {
        return rules_[layer] == scene::FillRule::NonZero ? windings_[layer] != 0 : windings_[layer] % 2 != 0;
    }

private:
    /// The paint where exactly the layers are inside for which isInside() says so.
    virtual PaintId compute() = 0;
    PaintId find();

    std::vector<scene::FillRule> rules_;
    std::vector<int> corner_, windings_;
    std::uint64_t sum_ = 0;      ///< Σ winding · mixed(layer)
    std::uint64_t key_ = 0;      ///< of the set of layers that are inside
    std::uint64_t lastKey_ = 0;  ///< asked for last, if any was
    PaintId last_ = 0;
    bool known_ = false;
    /// Paints by key: a few in a list, more in a map.
    std::vector<std::pair<std::uint64_t, PaintId>> few_;
    std::unordered_map<std::uint64_t, PaintId> many_;
};

}  // namespace vtm::compiler
