#include "compiler/src/snap.hpp"

#include <algorithm>

namespace vtm::compiler {
namespace {

// ---- clip -------------------------------------------------------------------------------------

/// Where a→b meets the line x = at (or y = at, with the axes exchanged), rounded to an even position
/// strictly inside the side.
Coord cutPosition(Coord a, Coord b, Coord aAcross, Coord bAcross, Coord at, Coord low, Coord high) {
    const Int128 run = std::int64_t{bAcross} - aAcross;
    const Int128 rise = std::int64_t{b} - a;
    const Int128 numerator = a * run + rise * (std::int64_t{at} - aAcross);
    const Coord cut = run > 0 ? roundToEven(numerator, run) : roundToEven(-numerator, -run);
    return std::clamp(cut, low + 1, high - 1);
}

/// The part of a chord inside the square, if it has any.
class Clipper {
public:
    explicit Clipper(const Square& square) : square_(square) {}

    std::optional<Chord> clip(const Chord& c) {
        for (int k = 0; k < 4; ++k)
            left_[static_cast<std::size_t>(k)] = cornerOnLeft(c.a, c.b, square_.corner(k));
        Chord part = c;
        const bool aInside = inside(c.a), bInside = inside(c.b);
        bool entered = aInside, left = bInside;
        for (std::size_t side = 0; side < 4; ++side) {
            const std::size_t next = (side + 1) % 4;
            if (left_[side] == left_[next] || !spans(c, side))
                continue;
            // The sides run counter-clockwise: the first corner of the side by which an edge comes in
            // lies on its left, of the one by which it leaves on its right.
            const bool enters = left_[side];
            (enters ? part.a : part.b) = cut(c, side);
            (enters ? entered : left) = true;
        }
        if (!entered || !left || part.a == part.b)
            return std::nullopt;
        return part;
    }

private:
    bool inside(LatticePoint p) const {
        return p.x > square_.x0 && p.x < square_.x1() && p.y > square_.y0 && p.y < square_.y1();
    }
    static bool vertical(std::size_t side) { return side % 2 == 1; }
    Coord line(std::size_t side) const {
        return side == 0 ? square_.y0 : side == 1 ? square_.x1() : side == 2 ? square_.y1() : square_.x0;
    }
    bool spans(const Chord& c, std::size_t side) const {
        const Coord at = line(side);
        return vertical(side) ? (c.a.x < at) != (c.b.x < at) : (c.a.y < at) != (c.b.y < at);
    }
    LatticePoint cut(const Chord& c, std::size_t side) const {
        const Coord at = line(side);
        if (vertical(side))
            return {at, cutPosition(c.a.y, c.b.y, c.a.x, c.b.x, at, square_.y0, square_.y1())};
        return {cutPosition(c.a.x, c.b.x, c.a.y, c.b.y, at, square_.x0, square_.x1()), at};
    }

    const Square square_;
    std::array<bool, 4> left_{};
};

// ---- snap -------------------------------------------------------------------------------------

Edge directed(LatticePoint a, LatticePoint b) { return a < b ? Edge{a, b} : Edge{b, a}; }

/// Strictly between the ends of an edge, for a point known to lie on its line.
bool between(const Edge& e, LatticePoint p) {
    return p != e.a && p != e.b && std::min(e.a.x, e.b.x) <= p.x && p.x <= std::max(e.a.x, e.b.x) &&
           std::min(e.a.y, e.b.y) <= p.y && p.y <= std::max(e.a.y, e.b.y);
}

/// The crossing of two edges that cross properly, rounded to even. `atA`, `atB`: orient(t, s.a),
/// orient(t, s.b), of opposite signs.
LatticePoint crossing(const Edge& s, std::int64_t atA, std::int64_t atB) {
    Int128 whole = Int128{atA} - atB, part = atA;
    if (whole < 0)
        whole = -whole, part = -part;
    const auto along = [&](Coord a, Coord b) {
        return roundToEven(a * whole + (std::int64_t{b} - a) * part, whole);
    };
    return {along(s.a.x, s.b.x), along(s.a.y, s.b.y)};
}

struct Split {
    std::uint32_t edge;
    LatticePoint at;
};

class Snapper {
public:
    explicit Snapper(EdgeSet set) : set_(std::move(set)) {}

    /// False if a limit is met first.
    bool run() {
        mergeEqual();
        fresh_.assign(set_.edges.size(), true);
        for (int round = 0; round < maxSnapRounds; ++round) {
            if (set_.edges.size() > maxLeafEdges || !findSplits())
                return false;
            if (splits_.empty())
                return true;
            applySplits();
            mergeEqual();
        }
        return false;
    }

    EdgeSet take() { return std::move(set_); }

private:
    bool findSplits() {
        splits_.clear();
        const std::vector<Edge>& edges = set_.edges;  // sorted by a, so by the smaller x
        for (std::uint32_t i = 0; i < edges.size(); ++i) {
            for (std::uint32_t j = i + 1; j < edges.size() && edges[j].a.x <= edges[i].b.x; ++j)
                if (fresh_[i] || fresh_[j])
                    test(i, j);
            if (splits_.size() > 4 * maxLeafEdges)
                return false;
        }
        return true;
    }

    void test(std::uint32_t i, std::uint32_t j) {
        const Edge &s = set_.edges[i], &t = set_.edges[j];
        if (std::max(s.a.y, s.b.y) < std::min(t.a.y, t.b.y) ||
            std::max(t.a.y, t.b.y) < std::min(s.a.y, s.b.y))
            return;
        const std::int64_t ta = orient(s.a, s.b, t.a), tb = orient(s.a, s.b, t.b);
        if ((ta > 0 && tb > 0) || (ta < 0 && tb < 0))
            return;
        const std::int64_t sa = orient(t.a, t.b, s.a), sb = orient(t.a, t.b, s.b);
        if ((sa > 0 && sb > 0) || (sa < 0 && sb < 0))
            return;
        if (ta != 0 && tb != 0 && sa != 0 && sb != 0) {
            const LatticePoint x = crossing(s, sa, sb);
            split(i, x);
            split(j, x);
            return;
        }
        splitAtVertex(i, ta, t.a);
        splitAtVertex(i, tb, t.b);
        splitAtVertex(j, sa, s.a);
        splitAtVertex(j, sb, s.b);
    }

    void splitAtVertex(std::uint32_t edge, std::int64_t side, LatticePoint p) {
        if (side == 0 && between(set_.edges[edge], p))
            splits_.push_back({edge, p});
    }

    void split(std::uint32_t edge, LatticePoint p) {
        if (p != set_.edges[edge].a && p != set_.edges[edge].b)
            splits_.push_back({edge, p});
    }

    /// Replaces every split edge by its parts, ordered along it.
    void applySplits() {
        std::vector<Edge> next;
        std::vector<std::uint8_t> fresh;
        std::sort(splits_.begin(), splits_.end(), [&](const Split& p, const Split& q) {
            return p.edge != q.edge ? p.edge < q.edge : progress(p) < progress(q);
        });
        std::size_t s = 0;
        for (std::uint32_t i = 0; i < set_.edges.size(); ++i) {
            const Edge& e = set_.edges[i];
            const bool whole = s == splits_.size() || splits_[s].edge != i;
            LatticePoint from = e.a;
            for (; s < splits_.size() && splits_[s].edge == i; ++s) {
                part(next, e, from, splits_[s].at);
                from = splits_[s].at;
            }
            part(next, e, from, e.b);
            fresh.resize(next.size(), !whole);
        }
        set_.edges = std::move(next);
        fresh_ = std::move(fresh);
    }

    std::int64_t progress(const Split& s) const {
        const Edge& e = set_.edges[s.edge];
        return (std::int64_t{e.b.x} - e.a.x) * (std::int64_t{s.at.x} - e.a.x) +
               (std::int64_t{e.b.y} - e.a.y) * (std::int64_t{s.at.y} - e.a.y);
    }

    /// A part may run against the whole (rounding can step back past a steep edge's end): then its
    /// changes are those of the reversed edge.
    void part(std::vector<Edge>& into, const Edge& whole, LatticePoint from, LatticePoint to) {
        if (from == to)
            return;
        Edge e = directed(from, to);
        e.firstChange = whole.firstChange;
        e.changeCount = whole.changeCount;
        if (e.a != from) {
            e.firstChange = static_cast<std::uint32_t>(set_.changes.size());
            for (std::uint32_t k = 0; k < whole.changeCount; ++k) {
                const Change c = set_.changes[whole.firstChange + k];
                set_.changes.push_back({c.layer, -c.winding});
            }
        }
        into.push_back(e);
    }

    /// Sorts the edges; equal ones become one with their changes added, and those without any
    /// change vanish.
    void mergeEqual() {
        std::vector<std::uint32_t> order(set_.edges.size());
        for (std::uint32_t i = 0; i < order.size(); ++i)
            order[i] = i;
        const auto key = [&](std::uint32_t i) { return std::pair{set_.edges[i].a, set_.edges[i].b}; };
        std::sort(order.begin(), order.end(),
                  [&](std::uint32_t i, std::uint32_t j) { return key(i) < key(j); });
        std::vector<Edge> merged;
        std::vector<std::uint8_t> fresh;
        for (std::size_t i = 0; i < order.size();) {
            std::size_t end = i + 1;
            bool isFresh = !fresh_.empty() && fresh_[order[i]];
            for (; end < order.size() && key(order[end]) == key(order[i]); ++end)
                isFresh = isFresh || (!fresh_.empty() && fresh_[order[end]]);
            Edge e = set_.edges[order[i]];
            if (end > i + 1)
                addChanges(e, {order.data() + i, end - i});
            if (e.changeCount > 0) {
                merged.push_back(e);
                fresh.push_back(isFresh);
            }
            i = end;
        }
        set_.edges = std::move(merged);
        fresh_ = std::move(fresh);
    }

    void addChanges(Edge& into, std::span<const std::uint32_t> equal) {
        sum_.clear();
        for (std::uint32_t i : equal) {
            const auto changes = set_.of(set_.edges[i]);
            sum_.insert(sum_.end(), changes.begin(), changes.end());
        }
        std::sort(sum_.begin(), sum_.end(),
                  [](const Change& p, const Change& q) { return p.layer < q.layer; });
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

    EdgeSet set_;
    std::vector<std::uint8_t> fresh_;  ///< made in the last round: only such edges can meet others anew
    std::vector<Split> splits_;
    std::vector<Change> sum_;
};

}  // namespace

std::optional<EdgeSet> snap(const Square& square, std::span<const LeafChord> chords) {
    EdgeSet set;
    Clipper clipper(square);
    for (const LeafChord& c : chords)
        if (const auto part = clipper.clip(c.chord)) {
            Edge e = directed(part->a, part->b);
            e.firstChange = static_cast<std::uint32_t>(set.changes.size());
            e.changeCount = 1;
            set.changes.push_back({c.layer, e.a == part->a ? 1 : -1});
            set.edges.push_back(e);
        }
    Snapper snapper(std::move(set));
    if (!snapper.run())
        return std::nullopt;
    return snapper.take();
}

}  // namespace vtm::compiler
