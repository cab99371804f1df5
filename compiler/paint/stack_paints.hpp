/// \file
/// The paints of an edited picture: one for each stack in use, at a place that lasts.
#pragma once

#include <unordered_map>
#include <vector>

#include "compiler/paint/palette.hpp"
#include "compiler/session/changes.hpp"

namespace vtm::compiler {

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
