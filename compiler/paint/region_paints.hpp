/// \file
/// Where one stands in a leaf: the winding numbers of its layers, and the paint that they make.
#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include <vtm/scene/path.hpp>
#include "compiler/containers/number_map.hpp"
#include "compiler/paint/palette.hpp"
#include "compiler/session/changes.hpp"

namespace vtm::compiler {

/// 64 well-mixed bits (SplitMix64): sums and exclusive ors of them vanish by chance once in 2^64.
inline std::uint64_t hashValue(std::uint64_t value) {
    std::uint64_t z = (value + 1) * 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

/// Walks from region to region. The paint of each set of layers is asked for once, until `forget`.
class RegionPaints {
public:
    struct Layer {
        scene::FillRule rule;
        int corner;          ///< winding at the first corner
        std::uint64_t name;  ///< well mixed: stands for the layer in the sets whose paints are known
    };

    virtual ~RegionPaints() = default;

    /// Enters a leaf, at its first corner.
    void enter(std::span<const Layer> layers);
    void forget() { known_.clear(); }
    /// Goes to the first corner.
    void toCorner();
    /// Crosses an edge of a layer.
    void change(std::uint32_t layer, int winding) {
        State& s = states_[layer];
        const bool before = s.isInside();
        s.winding += winding;
        sum_ += static_cast<std::uint64_t>(std::int64_t{winding}) * s.name;
        key_ ^= s.name & -std::uint64_t{before != s.isInside()};
    }
    /// The paint of the region.
    PaintId paint() {
        if (lastKey_ != key_)
            find();
        return last_;
    }
    /// Equal places have equal sums of their windings.
    std::uint64_t windingSum() const { return sum_; }
    bool isInside(std::uint32_t layer) const { return states_[layer].isInside(); }

protected:
    /// Of a set, by the names of its layers combined by exclusive or; unknown until the caller sets it.
    PaintId& known(std::uint64_t key) { return known_[key]; }

private:
    struct State {
        int winding, corner;
        int mask;  ///< of the winding's bits that matter: those of no even number, or all
        std::uint64_t name;
        bool isInside() const { return (winding & mask) != 0; }
    };

    /// The paint where exactly the layers are inside for which isInside() says so.
    virtual PaintId compute() = 0;
    void find();

    std::vector<State> states_;
    std::uint64_t sum_ = 0, cornerSum_ = 0;  ///< Σ winding · name
    std::uint64_t key_ = 0, cornerKey_ = 0;  ///< of the set of layers that are inside
    std::uint64_t lastKey_ = 0;              ///< asked for last
    PaintId last_ = 0;
    NumberMap known_;
};

class StackPaints {
public:
    StackPaints() { use({}); }  // paint 0 is transparent

    /// The stack's paint, which stays the same until it has been released as often as it was used.
    PaintId use(const Stack& stack);
    void release(PaintId id);

    /// Composites the stacks that are new, and those that hold a layer whose name is `changed`.
    /// Returns how many were.
    std::size_t update(const LoweredScene& picture, const LayerNames& names,
                       const std::vector<std::uint8_t>& changed);

    /// Writes the paints of the asset `after` and its data: the picture's own, then what programs need. Of
    /// `before`, the asset encoded last, all is taken over that did not change; nothing if `picture.data`
    /// did. Returns true if paints have other indices than before.
    bool encode(const LoweredScene& picture, bool dataChanged, const asset::Asset& before,
                asset::Asset& after, float& error);
    /// By paint: whether it is another one than the one last encoded; empty if none is.
    std::vector<std::uint8_t> changed() const;
    /// The asset's index of each paint, as last encoded.
    const std::vector<std::uint16_t>& indices() const { return indices_; }

private:
    struct Entry {
        const Stack* stack = nullptr;  ///< key of the index; null: free
        std::uint32_t users = 0;
        bool isNew = false, isChanged = false;
        std::uint64_t names = 0;  ///< a bit for each name modulo 64: most stacks need not be looked into
        PaintProgram program;
    };
    bool encodeAll(const LoweredScene& picture, asset::Asset& after, float& error);

    std::unordered_map<Stack, PaintId, StackHash> index_;
    std::vector<Entry> entries_;
    std::vector<PaintId> free_;
    std::vector<std::uint16_t> indices_;
    bool programsChanged_ = true;  ///< paints that are or were programs, since the last encoding
};

}  // namespace vtm::compiler
