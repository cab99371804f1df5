#include "compiler/planar/snap.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <vtm/limits/limits.hpp>
#include "compiler/planar/edges.hpp"

namespace vtm::compiler {
namespace {

/// The even number next to `share` of the way between two coordinates, none beyond them. Doubles are off by
/// 2^-22 steps at most.
Coord evenBetween(Coord from, Coord to, double share) {
    const auto [low, high] = std::minmax(from, to);
    const double nearest = 2 * std::floor((from + share * (double(to) - from)) / 2 + 0.5);
    return std::clamp(static_cast<Coord>(nearest), low + (low & 1), high - (high & 1));
}

/// The crossing of a→b with a chord that it crosses properly, rounded to even. `atA`, `atB`: on which
/// side of that chord the ends lie and how far, of opposite signs.
LatticePoint crossing(LatticePoint a, LatticePoint b, std::int64_t atA, std::int64_t atB) {
    const double share = static_cast<double>(atA) / (static_cast<double>(atA) - static_cast<double>(atB));
    return {evenBetween(a.x, b.x, share), evenBetween(a.y, b.y, share)};
}

}  // namespace

const EdgeSet* Snapper::run(const Square& square, Points points, std::span<const ClippedRun> clippedRuns,
                            double maxBend) {
    clip(square, points, clippedRuns);
    bool byPixels = false;
    for (int round = 0; round < maxSnapRounds; ++round) {
        if (set_.edges.size() > maxLeafEdges || !meetAll())
            return nullptr;
        if (cuts_.empty())
            return &set_;
        const bool beginsAgain = round > 0 && bentSquare_ > 0 && !byPixels;
        byPixels = byPixels || beginsAgain;
        if (beginsAgain && !beginAgainByPixels(square, points, clippedRuns))
            return nullptr;
        set_.bend += std::sqrt(bentSquare_);
        if (set_.bend > maxBend)
            return nullptr;
        cutter_.run(set_, cuts_);
        if (!beginsAgain && !cutter_.partsMeet(set_, close_, isRechecked_)) {
            merger_.merge(set_);
            return &set_;
        }
        merger_.sortAndMerge(set_);
    }
    return nullptr;
}

// ---- clip -------------------------------------------------------------------------------------

void Snapper::clip(const Square& square, Points points, std::span<const ClippedRun> clippedRuns) {
    set_.vertices.clear();
    set_.edges.clear();
    set_.changes.clear();
    set_.bend = 0;
    std::size_t maximum = 0;
    for (const ClippedRun& s : clippedRuns)
        maximum += s.last + 1 - s.first;
    set_.vertices.resize(maximum);
    std::uint32_t first = 0;
    for (const ClippedRun& s : clippedRuns) {
        const LatticePoint from = points[s.first], to = points[s.last];
        LatticePoint a = from, b = to;
        if (!isStrictlyInside(square, from))
            a = cutAtEntry(square, {from, points[s.first + 1]});
        if (!isStrictlyInside(square, to))
            b = cutAtEntry(square, {to, points[s.last - 1]});
        if (a == b && s.last == s.first + 1)
            continue;
        const std::uint32_t last = first + s.last - s.first;
        const bool reversed = b < a;
        LatticePoint* const chain = set_.vertices.data() + first;
        if (reversed) {
            std::swap(a, b);
            std::reverse_copy(points.begin() + s.first + 1, points.begin() + s.last, chain + 1);
        } else {
            std::copy(points.begin() + s.first + 1, points.begin() + s.last, chain + 1);
        }
        chain[0] = a;
        chain[last - first] = b;
        set_.edges.push_back({a, b, first, last, static_cast<std::uint32_t>(set_.changes.size()), 1});
        set_.changes.push_back({s.layer, reversed ? -1 : 1});
        first = last + 1;
    }
    set_.vertices.resize(first);
    merger_.sortAndMerge(set_);
}

// ---- meet -------------------------------------------------------------------------------------

void Snapper::findBoxes() {
    const std::size_t count = set_.edges.size();
    for (auto* side : {&left_, &right_, &low_, &high_})
        side->resize(count);
    found_.resize(count + 1);
    for (std::size_t i = 0; i < count; ++i) {
        const Edge& e = set_.edges[i];
        left_[i] = e.a.x;
        right_[i] = e.b.x;
        low_[i] = std::min(e.a.y, e.b.y);
        high_[i] = std::max(e.a.y, e.b.y);
    }
}

/// Lists the edges first .. last - 1 whose boxes reach from `low` to `high`; returns their number.
std::size_t Snapper::gather(std::size_t first, std::size_t last, Coord low, Coord high) {
    std::size_t count = 0;
    for (std::size_t j = first; j < last; ++j) {
        found_[count] = static_cast<std::uint32_t>(j);
        count += (low_[j] <= high) & (high_[j] >= low);
    }
    return count;
}

Snapper::Band Snapper::bandOf(const Edge& e) const {
    Band band{double(e.b.x) - e.a.x, double(e.b.y) - e.a.y, 0, 0, 0};
    band.perLength2 = 1 / (band.dx * band.dx + band.dy * band.dy);
    for (const LatticePoint v : set_.chain(e).subspan(1, e.chordCount() - 1)) {
        const double o = band.dx * (v.y - e.a.y) - band.dy * (v.x - e.a.x);
        band.low = std::min(band.low, o);
        band.high = std::max(band.high, o);
    }
    return band;
}

/// Whether one edge lies wholly beside the other's line, and still will when both have been bent by √2 steps.
/// The vertices of f lie in the parallelogram of its ends moved across by its band: p = q + perp(d_f) o /
/// |d_f|², so orient(e, p) = orient(e, q) + o (d_e · d_f) / |d_f|². Doubles are off by 2^-50 of |d_e| 2^30,
/// which is far below a step's |d_e|.
bool Snapper::areApart(std::uint32_t e, std::uint32_t f) const {
    const Edge &s = set_.edges[e], &t = set_.edges[f];
    const Band &bs = bands_[e], &bt = bands_[f];
    const double dot = bs.dx * bt.dx + bs.dy * bt.dy;
    const auto isBeside = [dot](const Edge& p, const Band& bp, const Edge& q, const Band& bq) {
        const double k = dot * bq.perLength2, atLow = k * bq.low, atHigh = k * bq.high;
        const double atA = bp.dx * (double(q.a.y) - p.a.y) - bp.dy * (double(q.a.x) - p.a.x),
                     atB = bp.dx * (double(q.b.y) - p.a.y) - bp.dy * (double(q.b.x) - p.a.x);
        const double low = std::min(atA, atB) + std::min(atLow, atHigh),
                     high = std::max(atA, atB) + std::max(atLow, atHigh);
        const double step = std::abs(bp.dx) + std::abs(bp.dy);
        return (low > bp.high + bendReach * step) | (high < bp.low - bendReach * step);
    };
    return isBeside(s, bs, t, bt) | isBeside(t, bt, s, bs);
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
        for (const LatticePoint v : set_.chain(g).subspan(1, g.chordCount() - 1)) {
            const std::int64_t o = orient(at, side, v);
            side = (leftmost ? o > 0 : o < 0) ? v : side;
        }
        return side;
    };
    const std::int64_t between = orient(at, extreme(e, turn > 0), extreme(f, turn < 0));
    return turn > 0 ? between > 0 : between < 0;
}

/// Whether f, which begins where e ends, is nowhere else in one column with it.
bool Snapper::meetInOneColumn(const Edge& e, const Edge& f) const {
    return set_.vertices[e.last - 1].x < e.b.x && set_.vertices[f.first + 1].x > f.a.x;
}

/// All edges with all others. False if too many meet.
bool Snapper::meetAll() {
    cuts_.clear();
    close_.clear();
    isRechecked_.assign(set_.edges.size(), false);
    bentSquare_ = 0;
    const std::vector<Edge>& edges = set_.edges;  // sorted by a, so by the smaller x
    if (edges.size() < 2)
        return true;
    findBoxes();
    bands_.clear();
    for (const Edge& e : edges)
        bands_.push_back(bandOf(e));
    for (std::uint32_t i = 0; i < edges.size(); ++i) {
        limits::check();
        std::size_t end = i + 1;
        while (end < edges.size() && left_[end] <= right_[i])
            ++end;
        const std::size_t count = gather(i + 1, end, low_[i], high_[i]);
        for (const std::uint32_t j : std::span(found_).first(count)) {
            const Edge &e = edges[i], &f = edges[j];
            const bool share = (e.a == f.a) | (e.b == f.b);
            if (!share && areApart(i, j))
                continue;
            isNear_ = share && fanOut(e, f);  // chords are not compared
            if (!isNear_ && !(e.b == f.a && meetInOneColumn(e, f)))
                meet(i, j);
            close_.push_back({i, j, isNear_});
        }
        if (cuts_.size() > 4 * maxLeafEdges)
            return false;
    }
    return true;
}

/// Rounded crossings have made new ones. So all begins again, and chords are cut not only where they cross
/// but at the middle of each hot pixel that they pass through: the pixels, two steps wide, of crossings and
/// of vertices inside chains. Then chords that are bent meet nowhere else (Hobby, Practical segment
/// intersection with finite precision output, 1999). Points on the leaf's border are not hot: there all
/// chords end. False if the cuts are too many.
bool Snapper::beginAgainByPixels(const Square& square, Points points,
                                 std::span<const ClippedRun> clippedRuns) {
    clip(square, points, clippedRuns);
    if (!meetAll())
        return false;
    hot_.clear();
    for (const Cut& cut : cuts_)
        hot_.push_back(cut.at);
    for (const Edge& e : set_.edges)
        for (const LatticePoint v : set_.chain(e).subspan(1, e.chordCount() - 1))
            hot_.push_back(v);
    std::ranges::sort(hot_);
    hot_.erase(std::ranges::unique(hot_).begin(), hot_.end());
    for (std::uint32_t edge = 0; edge < set_.edges.size(); ++edge) {
        limits::check();
        for (std::uint32_t chord = 0; chord < set_.edges[edge].chordCount(); ++chord)
            meetPixels(edge, chord);
        if (cuts_.size() > 4 * maxLeafEdges)
            return false;
    }
    return true;
}

/// Cuts the chord in hot pixels.
void Snapper::meetPixels(std::uint32_t edge, std::uint32_t chord) {
    const LatticePoint a = set_.vertex(set_.edges[edge], chord), b = set_.vertex(set_.edges[edge], chord + 1);
    const auto [low, high] = std::minmax(a.y, b.y);
    // A line passes through a square of side 2 about p if |orient(a, b, p)| is no more.
    const std::int64_t reach = std::int64_t{b.x} - a.x + high - low;
    for (auto p = std::ranges::lower_bound(hot_, a.x - 1, {}, &LatticePoint::x);
         p != hot_.end() && p->x <= b.x + 1; ++p) {
        if (p->y < low - 1 || p->y > high + 1 || *p == a || *p == b || std::abs(orient(a, b, *p)) > reach)
            continue;
        bend(a, b, *p);
        cut(edge, chord, *p, {*p, *p}, edge);
    }
}

/// How the chords a→b and c→d lie to each other: on which side of one the ends of the other are.
struct Snapper::Meeting {
    std::int64_t atC, atD;  ///< orient(a, b, ·)
    std::int64_t atA, atB;  ///< orient(c, d, ·)
    std::int64_t nearAB, nearCD;

    /// orient(a, b, d) - orient(a, b, c) = (b - a) × (d - c) = orient(c, d, a) - orient(c, d, b).
    Meeting(LatticePoint a, LatticePoint b, LatticePoint c, LatticePoint d) {
        const std::int64_t abX = std::int64_t{b.x} - a.x, abY = std::int64_t{b.y} - a.y,
                           cdX = std::int64_t{d.x} - c.x, cdY = std::int64_t{d.y} - c.y,
                           acX = std::int64_t{c.x} - a.x, acY = std::int64_t{c.y} - a.y;
        const std::int64_t turn = abX * cdY - abY * cdX;
        atC = abX * acY - abY * acX;
        atD = atC + turn;
        atA = acX * cdY - acY * cdX;
        atB = atA - turn;
        nearAB = bendReach * (std::abs(abX) + std::abs(abY));
        nearCD = bendReach * (std::abs(cdX) + std::abs(cdY));
    }
    bool isFar() const { return areBeyond(atC, atD, nearAB) | areBeyond(atA, atB, nearCD); }
};

/// All chords of e that meet chords of f. Both chains go to the right: the chord that ends first is done
/// with the other's. (Chords that only begin where another ends share a vertex with one that is looked at.)
void Snapper::meet(std::uint32_t e, std::uint32_t f) {
    const Edge &s = set_.edges[e], &t = set_.edges[f];
    const Coord left = std::max(s.a.x, t.a.x);
    const LatticePoint* const vertices = set_.vertices.data();
    const LatticePoint *pEnd = vertices + s.last, *qEnd = vertices + t.last;
    const LatticePoint *p = firstNotBelow(vertices + s.first + 1, pEnd, left),
                       *q = firstNotBelow(vertices + t.first + 1, qEnd, left);
    // Where a chord that ends in p, or q, has its lower end.
    const std::ptrdiff_t pLow = s.a.y < s.b.y ? -1 : 0, qLow = t.a.y < t.b.y ? -1 : 0;
    Coord column = left - 1;
    for (;;) {  // p and q end the chords at hand
        if ((p[pLow].y <= q[~qLow].y) & (q[qLow].y <= p[~pLow].y) & (p[-1].x <= q->x) & (q[-1].x <= p->x))
            if (const Meeting m(p[-1], *p, q[-1], *q); !m.isFar())
                meetChords(m, e, p, f, q);
        if (p->x == q->x && p->x != column) {
            column = p->x;
            meetUpright(e, p, f, q);
        }
        const bool moves = p->x <= q->x;
        if (moves ? p == pEnd : q == qEnd) {
            if (q == qEnd || p->x != q->x)
                return;
            ++q;  // it may stand upright where e ends
            continue;
        }
        p += moves;
        q += !moves;
    }
}

/// Chords of both that stand upright in the column where p and q end, which the walk passes by one after the
/// other.
void Snapper::meetUpright(std::uint32_t e, const LatticePoint* p, std::uint32_t f, const LatticePoint* q) {
    const LatticePoint* const vertices = set_.vertices.data();
    const Edge &s = set_.edges[e], &t = set_.edges[f];
    const Coord x = p->x;
    for (const LatticePoint* i = p; i <= vertices + s.last && i->x == x; ++i)
        for (const LatticePoint* j = q; i[-1].x == x && j <= vertices + t.last && j->x == x; ++j)
            if (j[-1].x == x && !(i == p && j == q) && overlap(i[-1].y, i->y, j[-1].y, j->y))
                meetChords(Meeting(i[-1], *i, j[-1], *j), e, i, f, j);
}

/// Chords that are not far from each other, which end in p and q.
void Snapper::meetChords(const Meeting& m, std::uint32_t e, const LatticePoint* p, std::uint32_t f,
                         const LatticePoint* q) {
    const LatticePoint a = p[-1], b = *p, c = q[-1], d = *q;
    const auto number = [this](const LatticePoint* end, std::uint32_t edge) {
        return static_cast<std::uint32_t>(end - set_.vertices.data()) - 1 - set_.edges[edge].first;
    };
    const std::uint32_t i = number(p, e), j = number(q, f);
    if (areBeyond(m.atC, m.atD, 0) | areBeyond(m.atA, m.atB, 0)) {
        isNear_ = true;
        return;
    }
    if (m.atA != 0 && m.atB != 0 && m.atC != 0 && m.atD != 0) {
        isNear_ |= !(areBeyond(m.atC, -m.atD, m.nearAB) & areBeyond(m.atA, -m.atB, m.nearCD));
        const LatticePoint x = crossing(a, b, m.atA, m.atB);
        bend(a, b, x);
        bend(c, d, x);
        cut(e, i, x, {c, d}, f);
        cut(f, j, x, {a, b}, e);
        return;
    }
    isNear_ = true;
    const auto touch = [&](LatticePoint at) {
        cut(e, i, at, {c, d}, f);
        cut(f, j, at, {a, b}, e);
    };
    if (m.atA == 0 && isOnChord(c, d, a))
        touch(a);
    if (m.atB == 0 && isOnChord(c, d, b))
        touch(b);
    if (m.atC == 0 && isOnChord(a, b, c))
        touch(c);
    if (m.atD == 0 && isOnChord(a, b, d))
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
void Snapper::cut(std::uint32_t edge, std::uint32_t chord, LatticePoint at, const Chord& by,
                  std::uint32_t byEdge) {
    const Edge& e = set_.edges[edge];
    if (at == e.a || at == e.b)
        return;
    if (e.a.x != e.b.x && (at.x == e.a.x || at.x == e.b.x))
        isRechecked_[edge] = true;  // it may meet one that ends in that column
    const LatticePoint to = set_.vertex(e, chord + 1);
    if (at == to) {
        cuts_.push_back({edge, chord + 1, at, 0, by, byEdge});
        return;
    }
    const LatticePoint from = set_.vertex(e, chord);
    const std::int64_t progress = (std::int64_t{to.x} - from.x) * (std::int64_t{at.x} - from.x) +
                                  (std::int64_t{to.y} - from.y) * (std::int64_t{at.y} - from.y);
    cuts_.push_back({edge, chord, at, progress, by, byEdge});
}

}  // namespace vtm::compiler
