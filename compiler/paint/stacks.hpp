/// \file
/// Stacks: what regions are made of while a picture is edited, instead of the colours that follow.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace vtm::compiler {

/// The items that show in a region, from the bottom, by the names of their layers (LayerNames); or several
/// such lists with `noIndex` between them, for the mean of their paints.
using Stack = std::vector<std::uint32_t>;

struct StackHash {
    std::size_t operator()(const Stack& stack) const;
};

/// The distinct stacks of a block. Stack 0 is empty.
class StackTable {
public:
    StackTable() = default;
    StackTable(StackTable&&) = default;
    StackTable& operator=(StackTable&&) = default;
    StackTable(const StackTable&) = delete;  // stacks_ points into index_

    std::uint32_t add(const Stack& stack);
    std::size_t size() const { return stacks_.size(); }
    const Stack& operator[](std::uint32_t id) const { return *stacks_[id]; }

private:
    std::unordered_map<Stack, std::uint32_t, StackHash> index_;
    std::vector<const Stack*> stacks_;  ///< keys of the index
};

}  // namespace vtm::compiler
