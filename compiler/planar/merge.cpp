#include "compiler/planar/merge.hpp"

#include <algorithm>
#include <utility>

#include "compiler/containers/small_sort.hpp"

namespace vtm::compiler {
namespace {

int compare(const EdgeSet& set, const Edge& e, const Edge& f) {
    if (e.b != f.b)
        return e.b < f.b ? -1 : 1;
    if (e.chordCount() != f.chordCount())
        return e.chordCount() < f.chordCount() ? -1 : 1;
    const auto p = set.chain(e), q = set.chain(f);
    const auto [i, j] = std::mismatch(p.begin(), p.end(), q.begin());
    return i == p.end() ? 0 : *i < *j ? -1 : 1;
}

}  // namespace

void EdgeMerger::sortAndMerge(EdgeSet& set) {
    order_.resize(set.edges.size());
    for (std::uint32_t i = 0; i < order_.size(); ++i)
        order_[i] = {sortKey(set.edges[i].a), i};
    sortByKey(order_, spareOrder_, [](const Place& p) { return p.a; });
    nextEdges_.clear();
    for (std::size_t i = 0; i < order_.size();) {
        std::size_t end = i + 1;
        while (end < order_.size() && order_[end].a == order_[i].a)
            ++end;
        if (end > i + 1)
            sortFew(order_.begin() + std::ptrdiff_t(i), order_.begin() + std::ptrdiff_t(end),
                    [&](const Place& p, const Place& q) {
                        const int c = compare(set, set.edges[p.edge], set.edges[q.edge]);
                        return c != 0 ? c < 0 : p.edge < q.edge;
                    });
        while (i < end) {
            Edge e = set.edges[order_[i].edge];
            const std::size_t first = i++;
            while (i < end && compare(set, set.edges[order_[i].edge], e) == 0)
                ++i;
            if (i > first + 1) {
                sum_.clear();
                for (std::size_t k = first; k < i; ++k)
                    collect(set.of(set.edges[order_[k].edge]));
                sumChanges(set, e);
            }
            if (e.changeCount > 0)
                nextEdges_.push_back(e);
        }
    }
    set.edges.swap(nextEdges_);
}

void EdgeMerger::merge(EdgeSet& set) {
    constexpr std::uint32_t taken = Slots::noIndex - 1;
    const std::vector<Edge>& edges = set.edges;
    slots_.reset(edges.size());
    nextEqual_.assign(edges.size(), Slots::noIndex);
    bool areDifferent = true;
    for (std::uint32_t i = 0; i < edges.size(); ++i) {
        std::uint32_t& last =
            slots_.find(sortKey(edges[i].a) + 3 * sortKey(edges[i].b),
                        [&](std::uint32_t k) { return compare(set, edges[k], edges[i]) == 0; });
        if (last != Slots::noIndex) {
            nextEqual_[last] = i;
            areDifferent = false;
        }
        last = i;
    }
    if (areDifferent)
        return;
    nextEdges_.clear();
    for (std::uint32_t i = 0; i < edges.size(); ++i) {
        if (nextEqual_[i] == taken)
            continue;
        Edge e = edges[i];
        if (nextEqual_[i] != Slots::noIndex) {
            sum_.clear();
            for (std::uint32_t k = i; k != Slots::noIndex;) {
                collect(set.of(edges[k]));
                k = std::exchange(nextEqual_[k], taken);
            }
            sumChanges(set, e);
        }
        if (e.changeCount > 0)
            nextEdges_.push_back(e);
    }
    set.edges.swap(nextEdges_);
}

void EdgeMerger::collect(std::span<const Change> changes) {
    sum_.insert(sum_.end(), changes.begin(), changes.end());
}

/// Gives the edge the sum of what has been collected.
void EdgeMerger::sumChanges(EdgeSet& set, Edge& into) {
    std::sort(sum_.begin(), sum_.end(), [](const Change& p, const Change& q) { return p.layer < q.layer; });
    into.firstChange = static_cast<std::uint32_t>(set.changes.size());
    for (std::size_t i = 0; i < sum_.size();) {
        Change total{sum_[i].layer, 0};
        for (; i < sum_.size() && sum_[i].layer == total.layer; ++i)
            total.winding += sum_[i].winding;
        if (total.winding != 0)
            set.changes.push_back(total);
    }
    into.changeCount = static_cast<std::uint32_t>(set.changes.size()) - into.firstChange;
}

}  // namespace vtm::compiler
