#include "compiler/planar/edges.hpp"

#include <algorithm>
#include <utility>

#include "compiler/containers/small_sort.hpp"

namespace vtm::compiler {
namespace {

/// Whether the chord of e from vertex v meets f anywhere but at an end of both edges.
bool meetsPart(const EdgeSet& set, const Edge& e, std::uint32_t v, const Edge& f) {
    const LatticePoint *const vertices = set.vertices.data(), *const end = vertices + f.last;
    const LatticePoint a = vertices[v], b = vertices[v + 1];
    if ((f.a.x > b.x) | (f.b.x < a.x) | !overlap(a.y, b.y, f.a.y, f.b.y))
        return false;
    const auto isEnd = [](const Edge& g, LatticePoint p) { return (p == g.a) | (p == g.b); };
    for (const LatticePoint* r = firstNotBelow(vertices + f.first + 1, end, a.x); r <= end && r[-1].x <= b.x;
         ++r) {
        const LatticePoint c = r[-1], d = *r;
        if (!overlap(a.y, b.y, c.y, d.y))
            continue;
        const bool fromA = (a == c) | (a == d), fromB = (b == c) | (b == d);
        if (fromA | fromB) {
            const LatticePoint at = fromA ? a : b, p = fromA ? b : a, q = at == c ? d : c;
            if (!isEnd(e, at) || !isEnd(f, at))
                return true;
            if (!(fromA & fromB) && orient(at, p, q) == 0 && ((p < at) == (q < at)))
                return true;
            continue;
        }
        const std::int64_t atC = orient(a, b, c), atD = orient(a, b, d), atA = orient(c, d, a),
                           atB = orient(c, d, b);
        if (!(areBeyond(atC, atD, 0) | areBeyond(atA, atB, 0)) &&
            (atA != 0 || atB != 0 || isOnChord(a, b, c) || isOnChord(c, d, a)))
            return true;
    }
    return false;
}

}  // namespace

/// By edge, and along it: counted out by edges, most of which have few.
void EdgeCutter::sort(std::size_t edges, std::vector<Cut>& cuts) {
    firstCuts_.assign(edges + 1, 0);
    for (const Cut& cut : cuts)
        ++firstCuts_[cut.edge + 1];
    for (std::size_t e = 0; e < edges; ++e)
        firstCuts_[e + 1] += firstCuts_[e];
    nextCuts_.resize(cuts.size());
    for (const Cut& cut : cuts)
        nextCuts_[firstCuts_[cut.edge]++] = cut;  // in the end, where the next edge's begin
    cuts.swap(nextCuts_);
    const auto isBefore = [](const Cut& p, const Cut& q) {
        return p.chord != q.chord ? p.chord < q.chord : p.progress < q.progress;
    };
    std::uint32_t first = 0;
    for (std::size_t e = 0; e < edges; first = firstCuts_[e++])
        if (firstCuts_[e] > first + 1)
            sortFew(cuts.begin() + first, cuts.begin() + firstCuts_[e], isBefore);
}

void EdgeCutter::run(EdgeSet& set, std::vector<Cut>& cuts) {
    sort(set.edges.size(), cuts);
    nextEdges_.clear();
    nextEdges_.swap(set.edges);
    parts_.clear();
    newChords_.clear();
    rechecked_.clear();
    const Cut* s = cuts.data();
    const Cut* const end = s + cuts.size();
    for (std::uint32_t i = 0; i < nextEdges_.size(); ++i) {
        beginParts(set);
        if (s == end || s->edge != i) {
            set.edges.push_back(nextEdges_[i]);
            continue;
        }
        const Cut *const first = s, *from = nullptr;
        for (; s != end && s->edge == i; from = s++)
            part(set, nextEdges_[i], from, s);
        part(set, nextEdges_[i], from, nullptr);
        recheck({first, s});
    }
    beginParts(set);
    std::sort(rechecked_.begin(), rechecked_.end());
    rechecked_.erase(std::unique(rechecked_.begin(), rechecked_.end()), rechecked_.end());
}

/// Has an edge checked again that cuts another one near a neighbouring cut of the same chord: that one may
/// bend the chord over it. The farther from their crossing, the farther are two chords from each other.
void EdgeCutter::recheck(std::span<const Cut> cuts) {
    const auto isAt = [](const Cut& p, const Cut& q) { return p.chord == q.chord && p.at == q.at; };
    const auto check = [&](const Cut& cut, LatticePoint at) {
        if (std::abs(orient(cut.by.a, cut.by.b, at)) <= 2 * near(cut.by.a, cut.by.b))
            rechecked_.push_back({cut.edge, cut.byEdge});
    };
    std::size_t before = 0;  // the first of those in the place before
    for (std::size_t here = 0, next; here < cuts.size(); before = here, here = next) {
        for (next = here + 1; next < cuts.size() && isAt(cuts[next], cuts[here]);)
            ++next;
        if (here == 0 || cuts[here].chord != cuts[before].chord)
            continue;
        for (std::size_t k = before; k < here; ++k)
            check(cuts[k], cuts[here].at);
        for (std::size_t k = here; k < next; ++k)
            check(cuts[k], cuts[before].at);
    }
}

void EdgeCutter::beginParts(const EdgeSet& set) {
    parts_.push_back(
        {static_cast<std::uint32_t>(set.edges.size()), static_cast<std::uint32_t>(newChords_.size())});
}

/// The part between two cuts, or an end where there is none. It may run against the whole: a vertical part of
/// a falling chain, or one chord, where rounding can step back past a steep edge's end.
void EdgeCutter::part(EdgeSet& set, const Edge& whole, const Cut* from, const Cut* to) {
    const auto isVertex = [&](const Cut& cut) { return cut.at == set.vertex(whole, cut.chord); };
    const bool newFrom = from && !isVertex(*from), newTo = to && !isVertex(*to);
    const std::uint32_t first = whole.first + (from ? from->chord + 1 : 1),
                        end = to ? whole.first + to->chord + newTo : whole.last;  // of the vertices between
    const LatticePoint a = from ? from->at : whole.a, b = to ? to->at : whole.b;
    const std::uint32_t between = end > first ? end - first : 0;
    if (a == b && between == 0)
        return;
    Edge e = whole;
    e.first = static_cast<std::uint32_t>(set.vertices.size());
    e.last = e.first + between + 1;
    set.vertices.resize(e.last + 1);
    LatticePoint* const chain = set.vertices.data() + e.first;
    std::copy_n(set.vertices.data() + first, between, chain + 1);
    chain[0] = a;
    chain[between + 1] = b;
    const bool reversed = b < a;
    const auto number = static_cast<std::uint32_t>(set.edges.size());
    const bool newFirst = reversed ? newTo : newFrom, newLast = reversed ? newFrom : newTo;
    if (newFirst || (newLast && between == 0))
        newChords_.push_back({number, e.first});
    if (newLast && between > 0)
        newChords_.push_back({number, e.first + between});
    if (reversed) {
        std::reverse(chain, chain + between + 2);
        e.firstChange = static_cast<std::uint32_t>(set.changes.size());
        for (std::uint32_t k = 0; k < e.changeCount; ++k) {
            const Change c = set.changes[whole.firstChange + k];
            set.changes.push_back({c.layer, -c.winding});
        }
    }
    e.a = chain[0];
    e.b = chain[between + 1];
    set.edges.push_back(e);
}

bool EdgeCutter::partsMeet(const EdgeSet& set, std::span<const EdgePair> close,
                           const std::vector<std::uint8_t>& isRechecked) const {
    const auto meet = [&](std::uint32_t e, std::uint32_t f) {
        return newMeet(set, e, f) || newMeet(set, f, e);
    };
    return std::any_of(close.begin(), close.end(),
                       [&](const EdgePair& pair) {
                           return (pair.isNear | isRechecked[pair.e] | isRechecked[pair.f]) &&
                                  meet(pair.e, pair.f);
                       }) ||
           std::any_of(rechecked_.begin(), rechecked_.end(),
                       [&](const auto& pair) { return meet(pair.first, pair.second); });
}

namespace {

/// How far rounding may move the parts of an edge past each other.
constexpr Coord rounded = 4;

/// Numbers first to end - 1 of edges that lie one after the other in y, but for what rounding moved them: the
/// first that may reach into low to high.
std::uint32_t firstReaching(const EdgeSet& set, std::uint32_t first, std::uint32_t end, bool rises, Coord low,
                            Coord high) {
    const auto isPast = [&](std::uint32_t k) {
        const Edge& e = set.edges[k];
        return rises ? std::max(e.a.y, e.b.y) + rounded < low : std::min(e.a.y, e.b.y) - rounded > high;
    };
    while (first < end) {
        const std::uint32_t middle = first + (end - first) / 2;
        if (isPast(middle))
            first = middle + 1;
        else
            end = middle;
    }
    return first;
}

}  // namespace

/// Whether a new chord of a part of edge e, as it was, meets a part of edge f. The parts of both lie one
/// after the other in x and in y, but for what rounding moved them.
bool EdgeCutter::newMeet(const EdgeSet& set, std::uint32_t e, std::uint32_t f) const {
    std::uint32_t first = parts_[f].edge;
    const std::uint32_t end = parts_[f + 1].edge;
    if (first == end)
        return false;
    const LatticePoint from = set.edges[first].a, to = set.edges[end - 1].b;
    if (std::abs(std::int64_t{to.y} - from.y) > std::int64_t{to.x} - from.x)
        return newMeetUpright(set, e, f);
    for (std::uint32_t k = parts_[e].newChord; k < parts_[e + 1].newChord; ++k) {
        const NewChord& chord = newChords_[k];
        const Coord left = set.vertices[chord.first].x - rounded,
                    right = set.vertices[chord.first + 1].x + rounded;
        while (first + 1 < end && set.edges[first].b.x < left)
            ++first;
        for (std::uint32_t j = first; j < end && set.edges[j].a.x <= right; ++j)
            if (meetsPart(set, set.edges[chord.edge], chord.first, set.edges[j]))
                return true;
    }
    return false;
}

/// The same where f is upright, so that many of its parts are in one column.
bool EdgeCutter::newMeetUpright(const EdgeSet& set, std::uint32_t e, std::uint32_t f) const {
    const std::uint32_t begin = parts_[f].edge, end = parts_[f + 1].edge;
    const bool rises = set.edges[end - 1].b.y > set.edges[begin].a.y;
    for (std::uint32_t k = parts_[e].newChord; k < parts_[e + 1].newChord; ++k) {
        const NewChord& chord = newChords_[k];
        const auto [low, high] = std::minmax(set.vertices[chord.first].y, set.vertices[chord.first + 1].y);
        // Of parts that are out of order by rounding, one may stand before those that are past.
        for (std::uint32_t j = firstReaching(set, begin, end, rises, low - rounded, high + rounded); j < end;
             ++j) {
            const Edge& part = set.edges[j];
            if (rises ? std::min(part.a.y, part.b.y) - rounded > high
                      : std::max(part.a.y, part.b.y) + rounded < low)
                break;
            if (meetsPart(set, set.edges[chord.edge], chord.first, part))
                return true;
        }
    }
    return false;
}

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
