#include "compiler/src/snap.hpp"

#include <algorithm>
#include <cmath>

#include "compiler/src/clip.hpp"

namespace vtm::compiler {
namespace {

bool isBetween(Coord low, Coord v, Coord high) { return low <= v && v <= high; }

/// Whether p, known to lie on the line of a→b, lies on the chord, ends included.
bool isOnChord(LatticePoint a, LatticePoint b, LatticePoint p) {
    return isBetween(std::min(a.x, b.x), p.x, std::max(a.x, b.x)) &&
           isBetween(std::min(a.y, b.y), p.y, std::max(a.y, b.y));
}

bool isEnd(const Edge& e, LatticePoint p) { return p == e.a || p == e.b; }

/// The crossing of a→b with a chord that it crosses properly, rounded to even. `atA`, `atB`: on which
/// side of that chord the ends lie and how far, of opposite signs.
LatticePoint crossing(LatticePoint a, LatticePoint b, std::int64_t atA, std::int64_t atB) {
    Int128 whole = Int128{atA} - atB, part = atA;
    if (whole < 0)
        whole = -whole, part = -part;
    const auto along = [&](Coord from, Coord to) {
        return roundToEven(from * whole + (std::int64_t{to} - from) * part, whole);
    };
    return {along(a.x, b.x), along(a.y, b.y)};
}

}  // namespace

const EdgeSet* Snapper::run(const Square& square, Points points, std::span<const Strand> strands) {
    set_.points = points;
    set_.edges.clear();
    set_.changes.clear();
    set_.bend = 0;
    clip(square, strands);
    fresh_.assign(set_.edges.size(), true);
    mergeEqual();
    for (int round = 0; round < maxSnapRounds; ++round) {
        if (set_.edges.size() > maxLeafEdges || !findSplits())
            return nullptr;
        if (splits_.empty())
            return &set_;
        set_.bend += std::sqrt(bentSquare_);
        applySplits();
        mergeEqual();
    }
    return nullptr;
}

// ---- clip -------------------------------------------------------------------------------------

void Snapper::clip(const Square& square, std::span<const Strand> strands) {
    for (const Strand& s : strands) {
        Chord ends{set_.points[s.first], set_.points[s.last]};
        if (s.last == s.first + 1) {
            const auto inside = compiler::clip(square, ends);
            if (!inside)
                continue;
            ends = *inside;
        } else {  // all vertices between the ends are inside
            if (!isInside(square, ends.a))
                ends.a = compiler::clip(square, {ends.a, set_.points[s.first + 1]})->a;
            if (!isInside(square, ends.b))
                ends.b = compiler::clip(square, {set_.points[s.last - 1], ends.b})->b;
        }
        Edge e{ends.a, ends.b, s.first + 1, s.last - s.first - 1, false, 0, 1};
        e.firstChange = static_cast<std::uint32_t>(set_.changes.size());
        set_.changes.push_back({s.layer, 1});
        if (e.b < e.a)
            reverse(e);
        set_.edges.push_back(e);
    }
}

// ---- meet -------------------------------------------------------------------------------------

Snapper::Band Snapper::bandOf(const Edge& e) const {
    Band band{static_cast<double>(std::int64_t{e.b.x} - e.a.x),
              static_cast<double>(std::int64_t{e.b.y} - e.a.y), 0, 0, 0};
    band.length2 = band.dx * band.dx + band.dy * band.dy;
    for (const LatticePoint v : set_.inner(e)) {
        const double o = band.dx * (v.y - e.a.y) - band.dy * (v.x - e.a.x);
        band.low = std::min(band.low, o);
        band.high = std::max(band.high, o);
    }
    return band;
}

/// Whether f lies wholly on one side of e, by more than a step. Its vertices lie in the parallelogram of
/// its ends moved across by its band: p = q + perp(d_f) o / |d_f|², so orient(e, p) = orient(e, q) + o
/// (d_e · d_f) / |d_f|². Doubles are off by 2^-50 of |d_e| 2^30, which is far below a step's |d_e|.
bool Snapper::isBeside(std::uint32_t e, std::uint32_t f) const {
    const Edge &s = set_.edges[e], &t = set_.edges[f];
    const Band &bs = bands_[e], &bt = bands_[f];
    const double k = (bs.dx * bt.dx + bs.dy * bt.dy) / bt.length2;
    const auto atA = static_cast<double>(orient(s.a, s.b, t.a)),
               atB = static_cast<double>(orient(s.a, s.b, t.b));
    const double low = std::min(atA, atB) + (k > 0 ? k * bt.low : k * bt.high);
    const double high = std::max(atA, atB) + (k > 0 ? k * bt.high : k * bt.low);
    const double step = std::abs(bs.dx) + std::abs(bs.dy);
    return low > bs.high + step || high < bs.low - step;
}

/// Whether e and f, which begin in one vertex (or end in one), have nothing else in common, since they leave
/// it within different sectors. Both lie in the half plane right (left) of it.
bool Snapper::fanOut(const Edge& e, const Edge& f) const {
    const bool fromA = e.a == f.a;
    const LatticePoint at = fromA ? e.a : e.b;
    const std::int64_t turn = orient(at, fromA ? e.b : e.a, fromA ? f.b : f.a);
    if (turn == 0)
        return false;
    // The sides of their sectors that face each other.
    const auto extreme = [&](const Edge& g, bool leftmost) {
        LatticePoint side = fromA ? g.b : g.a;
        for (const LatticePoint v : set_.inner(g)) {
            const std::int64_t o = orient(at, side, v);
            if (leftmost ? o > 0 : o < 0)
                side = v;
        }
        return side;
    };
    const std::int64_t between = orient(at, extreme(e, turn > 0), extreme(f, turn < 0));
    return turn > 0 ? between > 0 : between < 0;
}

bool Snapper::findSplits() {
    splits_.clear();
    bentSquare_ = 0;
    bands_.clear();
    boxes_.clear();
    for (const Edge& e : set_.edges) {
        const auto [low, high] = std::minmax(e.a.y, e.b.y);
        boxes_.push_back({e.a.x, e.b.x, low, high});
        bands_.push_back(bandOf(e));
    }
    const std::vector<Edge>& edges = set_.edges;  // sorted by a, so by the smaller x
    for (std::uint32_t i = 0; i < edges.size(); ++i) {
        const Box box = boxes_[i];
        for (std::uint32_t j = i + 1; j < edges.size() && boxes_[j].left <= box.right; ++j) {
            const Coord low = std::max(box.low, boxes_[j].low), high = std::min(box.high, boxes_[j].high);
            if (low > high || !(fresh_[i] || fresh_[j]))
                continue;
            const Coord left = boxes_[j].left, right = std::min(box.right, boxes_[j].right);
            const bool isPoint = left == right && low == high;  // harmless if it is an end of both
            if (!(isPoint && isEnd(edges[i], {left, low}) && isEnd(edges[j], {left, low})) &&
                !(shareEnd(edges[i], edges[j]) && fanOut(edges[i], edges[j])) && !isBeside(i, j) &&
                !isBeside(j, i))
                meet(i, j);
        }
        if (splits_.size() > 4 * maxLeafEdges)
            return false;
    }
    return true;
}

/// A chord of an edge, moving along it.
struct Snapper::Walk {
    const EdgeSet& set;
    const Edge& edge;
    std::uint32_t chord;
    LatticePoint from, to;

    /// At the first chord that ends at `left` or to its right.
    Walk(const EdgeSet& s, const Edge& e, Coord left)
        : set(s),
          edge(e),
          chord(firstWhere(0, e.innerCount, [&](std::uint32_t k) { return s.vertex(e, k + 1).x >= left; })),
          from(s.vertex(e, chord)),
          to(s.vertex(e, chord + 1)) {}

    bool isLast() const { return chord == edge.innerCount; }
    void next() {
        ++chord;
        from = to;
        to = set.vertex(edge, chord + 1);
    }
};

/// All chords of e that meet chords of f. Both chains go to the right: the chord that ends first is done
/// with the other's. (Chords that only begin where another ends share a vertex with one that is looked at.)
void Snapper::meet(std::uint32_t e, std::uint32_t f) {
    const Edge &s = set_.edges[e], &t = set_.edges[f];
    const Coord right = std::min(s.b.x, t.b.x);
    const Coord left = std::max(s.a.x, t.a.x);
    for (Walk p(set_, s, left), q(set_, t, left);;) {
        if (std::max(std::min(p.from.y, p.to.y), std::min(q.from.y, q.to.y)) <=
            std::min(std::max(p.from.y, p.to.y), std::max(q.from.y, q.to.y)))
            meetChords(e, p, f, q);
        const bool movesP = q.isLast() || (!p.isLast() && p.to.x <= q.to.x);
        Walk& mover = movesP ? p : q;
        if (mover.isLast() || mover.to.x > right)
            return;
        mover.next();
    }
}

void Snapper::meetChords(std::uint32_t e, const Walk& p, std::uint32_t f, const Walk& q) {
    const LatticePoint a = p.from, b = p.to, c = q.from, d = q.to;
    const std::int64_t atC = orient(a, b, c), atD = orient(a, b, d);
    if ((atC > 0 && atD > 0) || (atC < 0 && atD < 0))
        return;
    const std::int64_t atA = orient(c, d, a), atB = orient(c, d, b);
    if ((atA > 0 && atB > 0) || (atA < 0 && atB < 0))
        return;
    if (atA != 0 && atB != 0 && atC != 0 && atD != 0) {
        const LatticePoint x = crossing(a, b, atA, atB);
        bend(a, b, x);
        bend(c, d, x);
        split(e, p.chord, x);
        split(f, q.chord, x);
        return;
    }
    const auto touch = [&](LatticePoint at) {
        split(e, p.chord, at);
        split(f, q.chord, at);
    };
    if (atA == 0 && isOnChord(c, d, a))
        touch(a);
    if (atB == 0 && isOnChord(c, d, b))
        touch(b);
    if (atC == 0 && isOnChord(a, b, c))
        touch(c);
    if (atD == 0 && isOnChord(a, b, d))
        touch(d);
}

/// Notes that the chord a→b will run through a point beside it.
void Snapper::bend(LatticePoint a, LatticePoint b, LatticePoint to) {
    const double dx = double(b.x) - a.x, dy = double(b.y) - a.y;
    const double x = double(to.x) - a.x, y = double(to.y) - a.y;
    const double t = std::clamp((x * dx + y * dy) / (dx * dx + dy * dy), 0.0, 1.0);
    const double offX = x - t * dx, offY = y - t * dy;
    bentSquare_ = std::max(bentSquare_, offX * offX + offY * offY);
}

/// Asks for a cut of the edge at a point of its chord, unless that is an end of the whole edge.
void Snapper::split(std::uint32_t edge, std::uint32_t chord, LatticePoint at) {
    const Edge& e = set_.edges[edge];
    if (at == e.a || at == e.b)
        return;
    const LatticePoint to = set_.vertex(e, chord + 1);
    if (at == to) {
        splits_.push_back({edge, chord + 1, at, 0});
        return;
    }
    const LatticePoint from = set_.vertex(e, chord);
    const std::int64_t progress = (std::int64_t{to.x} - from.x) * (std::int64_t{at.x} - from.x) +
                                  (std::int64_t{to.y} - from.y) * (std::int64_t{at.y} - from.y);
    splits_.push_back({edge, chord, at, progress});
}

// ---- cut --------------------------------------------------------------------------------------

/// Replaces every split edge by its parts, ordered along it.
void Snapper::applySplits() {
    nextEdges_.clear();
    nextFresh_.clear();
    std::sort(splits_.begin(), splits_.end(), [](const Split& p, const Split& q) {
        return p.edge != q.edge     ? p.edge < q.edge
               : p.chord != q.chord ? p.chord < q.chord
                                    : p.progress < q.progress;
    });
    std::size_t s = 0;
    for (std::uint32_t i = 0; i < set_.edges.size(); ++i) {
        const Edge e = set_.edges[i];
        const bool whole = s == splits_.size() || splits_[s].edge != i;
        LatticePoint from = e.a;
        std::uint32_t inner = 1;  // the next inner vertex
        for (; s < splits_.size() && splits_[s].edge == i; ++s) {
            const Split& cut = splits_[s];
            const bool atVertex = cut.at == set_.vertex(e, cut.chord);
            part(e, from, cut.at, inner, atVertex ? cut.chord : cut.chord + 1, true);
            from = cut.at;
            inner = cut.chord + 1;
        }
        part(e, from, e.b, inner, e.innerCount + 1, !whole);
    }
    set_.edges.swap(nextEdges_);
    fresh_.swap(nextFresh_);
}

void Snapper::reverse(Edge& e) {
    std::swap(e.a, e.b);
    if (e.innerCount > 0) {
        e.inner = e.backward ? e.inner + 1 - e.innerCount : e.inner + e.innerCount - 1;
        e.backward = !e.backward;
    }
    const std::uint32_t first = e.firstChange;
    e.firstChange = static_cast<std::uint32_t>(set_.changes.size());
    for (std::uint32_t k = 0; k < e.changeCount; ++k) {
        const Change c = set_.changes[first + k];
        set_.changes.push_back({c.layer, -c.winding});
    }
}

/// The part between two points with the vertices firstInner .. innerEnd - 1 of the whole. It may run
/// against the whole: a vertical part of a falling chain, or one chord, where rounding can step back
/// past a steep edge's end.
void Snapper::part(const Edge& whole, LatticePoint from, LatticePoint to, std::uint32_t firstInner,
                   std::uint32_t innerEnd, bool fresh) {
    Edge e = whole;
    e.innerCount = innerEnd > firstInner ? innerEnd - firstInner : 0;
    if (from == to && e.innerCount == 0)
        return;
    e.inner = whole.backward ? whole.inner + 1 - firstInner : whole.inner + firstInner - 1;
    e.a = from;
    e.b = to;
    if (to < from)
        reverse(e);
    nextEdges_.push_back(e);
    nextFresh_.push_back(fresh);
}

// ---- merge ------------------------------------------------------------------------------------

int Snapper::compare(const Edge& e, const Edge& f) const {
    if (e.a != f.a)
        return e.a < f.a ? -1 : 1;
    if (e.b != f.b)
        return e.b < f.b ? -1 : 1;
    if (e.innerCount != f.innerCount)
        return e.innerCount < f.innerCount ? -1 : 1;
    for (std::uint32_t k = 1; k <= e.innerCount; ++k) {
        const LatticePoint p = set_.vertex(e, k), q = set_.vertex(f, k);
        if (p != q)
            return p < q ? -1 : 1;
    }
    return 0;
}

/// Sorts the edges; equal ones become one with their changes added, and those without any change
/// vanish.
void Snapper::mergeEqual() {
    order_.resize(set_.edges.size());
    for (std::uint32_t i = 0; i < order_.size(); ++i)
        order_[i] = {sortKey(set_.edges[i].a), i};
    std::sort(order_.begin(), order_.end(), [&](const Place& p, const Place& q) {
        if (p.a != q.a)
            return p.a < q.a;
        const int c = compare(set_.edges[p.edge], set_.edges[q.edge]);
        return c != 0 ? c < 0 : p.edge < q.edge;
    });
    nextEdges_.clear();
    nextFresh_.clear();
    for (std::size_t i = 0; i < order_.size();) {
        Edge e = set_.edges[order_[i].edge];
        std::size_t end = i + 1;
        bool fresh = fresh_[order_[i].edge];
        for (; end < order_.size() && order_[end].a == order_[i].a &&
               compare(set_.edges[order_[end].edge], e) == 0;
             ++end)
            fresh = fresh || fresh_[order_[end].edge];
        if (end > i + 1)
            addChanges(e, {order_.data() + i, end - i});
        if (e.changeCount > 0) {
            nextEdges_.push_back(e);
            nextFresh_.push_back(fresh);
        }
        i = end;
    }
    set_.edges.swap(nextEdges_);
    fresh_.swap(nextFresh_);
}

void Snapper::addChanges(Edge& into, std::span<const Place> equal) {
    sum_.clear();
    for (const Place& place : equal) {
        const auto changes = set_.of(set_.edges[place.edge]);
        sum_.insert(sum_.end(), changes.begin(), changes.end());
    }
    std::sort(sum_.begin(), sum_.end(), [](const Change& p, const Change& q) { return p.layer < q.layer; });
    into.firstChange = static_cast<std::uint32_t>(set_.changes.size());
    for (std::size_t i = 0; i < sum_.size();) {
        Change total{sum_[i].layer, 0};
        for (; i < sum_.size() && sum_[i].layer == total.layer; ++i)
            total.winding += sum_[i].winding;
        if (total.winding != 0)
            set_.changes.push_back(total);
    }
    into.changeCount = static_cast<std::uint32_t>(set_.changes.size()) - into.firstChange;
}

}  // namespace vtm::compiler
