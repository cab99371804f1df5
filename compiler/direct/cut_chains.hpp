/// \file
/// The chains that a row cuts, as rows go down a band.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "compiler/direct/view_chains.hpp"

namespace vtm::compiler {

/// A chain that the row cuts, and the edge of it that was looked at last. Many are gone through again and
/// again, so there is no more in it.
struct CutChain {
    glm::vec2 a;                   ///< the edge's upper end, or where the chain goes down first
    float slope = 0;               ///< dx / dy
    float edgeBottom = -INFINITY;  ///< where it ends; none at first
    std::uint32_t at;              ///< the upper end's vertex
    std::uint32_t last;            ///< the chain's
    std::uint32_t layer;
    std::int32_t winding;

    /// Whether the edge goes from the one height to the other.
    bool spans(float top, float bottom) const { return a.y <= top && edgeBottom >= bottom; }
    float xAt(float y) const { return slope == 0 ? a.x : a.x + (std::min(y, edgeBottom) - a.y) * slope; }
};

/// dx / dy; 0 of edges that are level, or so nearly that nothing lies beside them.
inline float slopeOf(glm::vec2 a, glm::vec2 b) {
    constexpr float steepest = 1e9f;
    const float slope = (b.x - a.x) / (b.y - a.y);
    return std::abs(slope) < steepest ? slope : 0;
}

/// Goes on to the edge at y, or the last.
inline void findEdge(CutChain& cut, float y, const glm::vec2* vertices) {
    while (cut.at + 1 < cut.last && vertices[cut.at + 1].y <= y)
        ++cut.at;
    const glm::vec2 a = vertices[cut.at], b = vertices[cut.at + 1];
    cut.a = a;
    cut.slope = slopeOf(a, b);
    cut.edgeBottom = b.y;
}

/// Chains' vertices lie far from each other: those of a chain some way behind are fetched, if it is to be
/// looked at for an edge.
inline void fetchAhead(std::span<const CutChain> cuts, std::size_t number, float bottom,
                       const glm::vec2* vertices) {
    constexpr std::size_t ahead = 16;
    if (number + ahead < cuts.size() && cuts[number + ahead].edgeBottom < bottom)
        __builtin_prefetch(vertices + cuts[number + ahead].at + 1);
}

/// Takes the chains of a band from row to row.
class ChainTaker {
public:
    explicit ChainTaker(const ViewChains& chains) : chains_(chains) {}

    /// Numbers of a band's chains, from the top.
    void begin(std::span<const std::uint32_t> numbers) { toCome_ = numbers; }
    /// Of those that begin above the bottom, and that isTaken(chain) wants, come; those that end above the
    /// top go. They are in the order isBefore(cut, cut).
    template <class IsTaken, class IsBefore>
    void take(float top, float bottom, std::vector<CutChain>& cuts, const IsTaken& isTaken,
              const IsBefore& isBefore);

private:
    const ViewChains& chains_;
    std::span<const std::uint32_t> toCome_;
    std::vector<CutChain> begun_, merged_;
};

template <class IsTaken, class IsBefore>
void ChainTaker::take(float top, float bottom, std::vector<CutChain>& cuts, const IsTaken& isTaken,
                      const IsBefore& isBefore) {
    const glm::vec2* const vertices = chains_.vertices();
    begun_.clear();
    std::size_t begun = 0;
    for (; begun < toCome_.size() && chains_[toCome_[begun]].top < bottom; ++begun) {
        const DownChain& chain = chains_[toCome_[begun]];
        if (chain.bottom <= top || !isTaken(chain))
            continue;
        std::uint32_t down = chain.first;
        while (down + 2 < chain.end && vertices[down + 1].y == vertices[down].y)
            ++down;
        begun_.push_back({.a = vertices[down],
                          .at = chain.first,
                          .last = chain.end - 1,
                          .layer = chain.layer,
                          .winding = chain.winding});
    }
    toCome_ = toCome_.subspan(begun);
    std::ranges::stable_sort(begun_, isBefore);
    merged_.clear();
    auto next = begun_.begin();
    for (const CutChain& cut : cuts) {
        if (cut.edgeBottom <= top && vertices[cut.last].y <= top)
            continue;
        for (; next != begun_.end() && isBefore(*next, cut); ++next)
            merged_.push_back(*next);
        merged_.push_back(cut);
    }
    merged_.insert(merged_.end(), next, begun_.end());
    cuts.swap(merged_);
}

}  // namespace vtm::compiler
