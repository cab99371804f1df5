/// \file
/// Which chains of one layer stay inside it between two vertices, wherever they cross each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace vtm::compiler {

/// A chain between two vertices: the columns that it reaches, and what crossing it adds to the winding
/// number.
struct ReachingChain {
    float left, right;
    std::int32_t winding;
};

/// A chain is quiet if the winding numbers on both its sides keep one sign whatever the order of the chains
/// that reach into its columns: whoever crosses it there is inside too. Numbers are bounded by the chains
/// that are left of it in any order, and those that may be.
class QuietChains {
public:
    /// `base`: the winding number on the left of all of them. For a layer with the non-zero rule.
    void find(std::span<const ReachingChain> chains, std::int32_t base);

    bool isQuiet(std::size_t chain) const { return isQuiet_[chain] != 0; }
    std::size_t count() const { return count_; }
    /// What the quiet chains on the left of a column add. Nothing where one reaches beyond it, and all is
    /// inside.
    std::optional<std::int32_t> windingLeftOf(float x) const;

private:
    /// Numbers by an end of chains, ascending; `sum`: of the windings up to there.
    struct End {
        float x;
        std::int32_t sum;
    };
    /// The sum of those whose end is below x; with those that end there.
    static std::int32_t before(const std::vector<End>& ends, float x);
    static std::int32_t upTo(const std::vector<End>& ends, float x);
    static void add(std::vector<End>& ends);

    std::vector<End> rights_, lefts_;  ///< of chains that add and of those that subtract; then of quiet ones
    std::vector<std::uint8_t> isQuiet_;
    std::size_t count_ = 0;
};

}  // namespace vtm::compiler
