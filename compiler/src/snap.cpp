#include "compiler/src/snap.hpp"

#include <algorithm>
#include <cmath>

#include "compiler/src/clip.hpp"
#include "compiler/src/small_sort.hpp"

namespace vtm::compiler {
namespace {

bool isBetween(Coord low, Coord v, Coord high) { return low <= v && v <= high; }

/// Whether p, known to lie on the line of a→b, lies on the chord, ends included.
bool isOnChord(LatticePoint a, LatticePoint b, LatticePoint p) {
    return isBetween(std::min(a.x, b.x), p.x, std::max(a.x, b.x)) &&
           isBetween(std::min(a.y, b.y), p.y, std::max(a.y, b.y));
}

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

/// The first of first .. last - 1, whose x rise, that is not below x; else last. Its steps depend on the
/// count alone.
const LatticePoint* firstNotBelow(const LatticePoint* first, const LatticePoint* last, Coord x) {
    auto count = last - first;
    for (; count > 1; count -= count / 2)
        first += first[count / 2 - 1].x < x ? count / 2 : 0;
    return first + (count == 1 && first->x < x);
}

/// Steps, more than two edges that are bent by √2 come nearer to each other.
constexpr int bendReach = 3;

/// orient(a, b, ·) of points within bendReach of the line a→b is no more.
std::int64_t near(LatticePoint a, LatticePoint b) {
    return bendReach * (std::abs(std::int64_t{b.x} - a.x) + std::abs(std::int64_t{b.y} - a.y));
}

/// Whether both are on one side of zero, and farther from it than `reach`.
bool areBeyond(std::int64_t p, std::int64_t q, std::int64_t reach) {
    return ((p > reach) & (q > reach)) | ((p < -reach) & (q < -reach));
}

bool overlap(Coord a, Coord b, Coord c, Coord d) {
    return std::max(std::min(a, b), std::min(c, d)) <= std::min(std::max(a, b), std::max(c, d));
}

}  // namespace

const EdgeSet* Snapper::run(const Square& square, Points points, std::span<const Strand> strands) {
    set_.vertices.clear();
    set_.edges.clear();
    set_.changes.clear();
    set_.bend = 0;
    clip(square, points, strands);
    mergeEqual();
    for (int round = 0; round < maxSnapRounds; ++round) {
        if (set_.edges.size() > maxLeafEdges || !meetAll())
            return nullptr;
        if (splits_.empty())
            return &set_;
        set_.bend += std::sqrt(bentSquare_);
        applySplits();
        const bool isDone = !partsMeet();
        mergeEqual();
        if (isDone)
            return &set_;
    }
    return nullptr;
}

// ---- clip -------------------------------------------------------------------------------------

void Snapper::clip(const Square& square, Points points, std::span<const Strand> strands) {
    for (const Strand& s : strands) {
        const LatticePoint from = points[s.first], to = points[s.last];
        LatticePoint a = from, b = to;
        if (!isInside(square, from))
            a = cutAtEntry(square, {from, points[s.first + 1]});
        if (!isInside(square, to))
            b = cutAtEntry(square, {to, points[s.last - 1]});
        if (a == b && s.last == s.first + 1)
            continue;
        Edge e;
        e.first = static_cast<std::uint32_t>(set_.vertices.size());
        set_.vertices.insert(set_.vertices.end(), points.begin() + s.first, points.begin() + s.last + 1);
        set_.vertices[e.first] = a;
        set_.vertices.back() = b;
        e.firstChange = static_cast<std::uint32_t>(set_.changes.size());
        e.changeCount = 1;
        const bool reversed = b < a;
        set_.changes.push_back({s.layer, reversed ? -1 : 1});
        add(e, reversed);
    }
}

/// Adds an edge that has the vertices from e.first on, in the order from b to a if `reversed`.
void Snapper::add(const Edge& edge, bool reversed) {
    Edge e = edge;
    e.last = static_cast<std::uint32_t>(set_.vertices.size() - 1);
    if (reversed)
        std::reverse(set_.vertices.begin() + e.first, set_.vertices.end());
    e.a = set_.vertices[e.first];
    e.b = set_.vertices[e.last];
    set_.edges.push_back(e);
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
    splits_.clear();
    close_.clear();
    isDoubtful_.assign(set_.edges.size(), false);
    bentSquare_ = 0;
    findBoxes();
    const std::vector<Edge>& edges = set_.edges;  // sorted by a, so by the smaller x
    bands_.clear();
    for (const Edge& e : edges)
        bands_.push_back(bandOf(e));
    for (std::uint32_t i = 0; i < edges.size(); ++i) {
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
        if (splits_.size() > 4 * maxLeafEdges)
            return false;
    }
    return true;
}

/// All chords of e that meet chords of f. Both chains go to the right: the chord that ends first is done
/// with the other's. (Chords that only begin where another ends share a vertex with one that is looked at.)
void Snapper::meet(std::uint32_t e, std::uint32_t f) {
    const Edge &s = set_.edges[e], &t = set_.edges[f];
    const Coord right = std::min(s.b.x, t.b.x), left = std::max(s.a.x, t.a.x);
    const LatticePoint* const vertices = set_.vertices.data();
    const LatticePoint *pEnd = vertices + s.last, *qEnd = vertices + t.last;
    const LatticePoint *p = firstNotBelow(vertices + s.first + 1, pEnd, left),
                       *q = firstNotBelow(vertices + t.first + 1, qEnd, left);
    for (;;) {  // p and q end the chords at hand
        if (overlap(p[-1].y, p->y, q[-1].y, q->y) & (p[-1].x <= q->x) & (q[-1].x <= p->x))
            meetChords(e, static_cast<std::uint32_t>(p - vertices) - 1 - s.first, f,
                       static_cast<std::uint32_t>(q - vertices) - 1 - t.first);
        const bool moves = (q == qEnd) | ((p != pEnd) & (p->x <= q->x));
        if (moves ? (p == pEnd) | (p->x > right) : q->x > right)
            return;
        p += moves;
        q += !moves;
    }
}

void Snapper::meetChords(std::uint32_t e, std::uint32_t i, std::uint32_t f, std::uint32_t j) {
    const LatticePoint a = set_.vertex(set_.edges[e], i), b = set_.vertex(set_.edges[e], i + 1),
                       c = set_.vertex(set_.edges[f], j), d = set_.vertex(set_.edges[f], j + 1);
    const std::int64_t atC = orient(a, b, c), atD = orient(a, b, d), atA = orient(c, d, a),
                       atB = orient(c, d, b);
    const std::int64_t nearAB = near(a, b), nearCD = near(c, d);
    if (areBeyond(atC, atD, nearAB) | areBeyond(atA, atB, nearCD))
        return;
    if (areBeyond(atC, atD, 0) | areBeyond(atA, atB, 0)) {
        isNear_ = true;
        return;
    }
    if (atA != 0 && atB != 0 && atC != 0 && atD != 0) {
        isNear_ |= !(areBeyond(atC, -atD, nearAB) & areBeyond(atA, -atB, nearCD));
        const LatticePoint x = crossing(a, b, atA, atB);
        bend(a, b, x);
        bend(c, d, x);
        split(e, i, x, {c, d});
        split(f, j, x, {a, b});
        return;
    }
    isNear_ = true;
    const auto touch = [&](LatticePoint at) {
        split(e, i, at, {c, d});
        split(f, j, at, {a, b});
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
void Snapper::split(std::uint32_t edge, std::uint32_t chord, LatticePoint at, const Chord& by) {
    const Edge& e = set_.edges[edge];
    if (at == e.a || at == e.b)
        return;
    if (e.a.x != e.b.x && (at.x == e.a.x || at.x == e.b.x))
        isDoubtful_[edge] = true;  // it may meet one that ends in that column
    const LatticePoint to = set_.vertex(e, chord + 1);
    if (at == to) {
        splits_.push_back({edge, chord + 1, at, 0, by});
        return;
    }
    const LatticePoint from = set_.vertex(e, chord);
    const std::int64_t progress = (std::int64_t{to.x} - from.x) * (std::int64_t{at.x} - from.x) +
                                  (std::int64_t{to.y} - from.y) * (std::int64_t{at.y} - from.y);
    splits_.push_back({edge, chord, at, progress, by});
}

// ---- cut --------------------------------------------------------------------------------------

/// Replaces every split edge by its parts, ordered along it.
void Snapper::applySplits() {
    std::sort(splits_.begin(), splits_.end(), [](const Split& p, const Split& q) {
        return p.edge != q.edge     ? p.edge < q.edge
               : p.chord != q.chord ? p.chord < q.chord
                                    : p.progress < q.progress;
    });
    nextEdges_.clear();
    nextEdges_.swap(set_.edges);
    parts_.clear();
    newChords_.clear();
    const Split* s = splits_.data();
    const Split* const end = s + splits_.size();
    for (std::uint32_t i = 0; i < nextEdges_.size(); ++i) {
        beginParts();
        if (s == end || s->edge != i) {
            set_.edges.push_back(nextEdges_[i]);
            continue;
        }
        const Split* from = nullptr;
        for (; s != end && s->edge == i; from = s++) {
            if (from && from->chord == s->chord && from->at != s->at && !areClear(*from, *s))
                isDoubtful_[i] = true;
            part(nextEdges_[i], from, s);
        }
        part(nextEdges_[i], from, nullptr);
    }
    beginParts();
}

/// Whether neither of two neighbouring cuts of a chord is near the chord that makes the other one: else a
/// third may be bent over one. The farther from its crossing, the farther are chords from each other.
bool Snapper::areClear(const Split& p, const Split& q) {
    const auto isClear = [](const Chord& c, LatticePoint at) {
        return std::abs(orient(c.a, c.b, at)) > 2 * near(c.a, c.b);
    };
    return isClear(p.by, q.at) && isClear(q.by, p.at);
}

void Snapper::beginParts() {
    parts_.push_back(
        {static_cast<std::uint32_t>(set_.edges.size()), static_cast<std::uint32_t>(newChords_.size())});
}

/// The part between two cuts, or an end where there is none. It may run against the whole: a vertical part of
/// a falling chain, or one chord, where rounding can step back past a steep edge's end.
void Snapper::part(const Edge& whole, const Split* from, const Split* to) {
    const auto isVertex = [&](const Split& cut) { return cut.at == set_.vertex(whole, cut.chord); };
    const bool newFrom = from && !isVertex(*from), newTo = to && !isVertex(*to);
    const std::uint32_t first = whole.first + (from ? from->chord + 1 : 1),
                        end = to ? whole.first + to->chord + newTo : whole.last;  // of the vertices between
    const LatticePoint a = from ? from->at : whole.a, b = to ? to->at : whole.b;
    const std::uint32_t between = end > first ? end - first : 0;
    if (a == b && between == 0)
        return;
    Edge e = whole;
    e.first = static_cast<std::uint32_t>(set_.vertices.size());
    set_.vertices.push_back(a);
    for (std::uint32_t v = first; v < first + between; ++v)
        set_.vertices.push_back(set_.vertices[v]);
    set_.vertices.push_back(b);
    const bool reversed = b < a;
    const auto number = static_cast<std::uint32_t>(set_.edges.size());
    const bool newFirst = reversed ? newTo : newFrom, newLast = reversed ? newFrom : newTo;
    if (newFirst || (newLast && between == 0))
        newChords_.push_back({number, e.first});
    if (newLast && between > 0)
        newChords_.push_back({number, e.first + between});
    if (reversed) {
        e.firstChange = static_cast<std::uint32_t>(set_.changes.size());
        for (std::uint32_t k = 0; k < e.changeCount; ++k) {
            const Change c = set_.changes[whole.firstChange + k];
            set_.changes.push_back({c.layer, -c.winding});
        }
    }
    add(e, reversed);
}

// ---- check ------------------------------------------------------------------------------------

/// Whether parts meet anywhere but at their ends. A bent chord stays in the box of the chord that it was, so
/// only edges that were close can; most of these have been seen to stay clear of each other but where they
/// cross.
bool Snapper::partsMeet() const {
    return std::any_of(close_.begin(), close_.end(), [&](const Pair& pair) {
        return (pair.isNear | isDoubtful_[pair.e] | isDoubtful_[pair.f]) &&
               (newMeet(pair.e, pair.f) || newMeet(pair.f, pair.e));
    });
}

/// Whether a new chord of a part of edge e, as it was, meets a part of edge f. The parts of both lie one
/// after the other in x, but for what rounding moved them.
bool Snapper::newMeet(std::uint32_t e, std::uint32_t f) const {
    constexpr Coord rounded = 4;
    std::uint32_t first = parts_[f].edge;
    const std::uint32_t end = parts_[f + 1].edge;
    for (std::uint32_t k = parts_[e].newChord; k < parts_[e + 1].newChord; ++k) {
        const NewChord& chord = newChords_[k];
        const Coord left = set_.vertices[chord.first].x - rounded,
                    right = set_.vertices[chord.first + 1].x + rounded;
        while (first + 1 < end && set_.edges[first].b.x < left)
            ++first;
        for (std::uint32_t j = first; j < end && set_.edges[j].a.x <= right; ++j)
            if (meetsPart(set_.edges[chord.edge], chord.first, set_.edges[j]))
                return true;
    }
    return false;
}

/// Whether the chord of e from vertex v meets f anywhere but at an end of both edges.
bool Snapper::meetsPart(const Edge& e, std::uint32_t v, const Edge& f) const {
    const LatticePoint *const vertices = set_.vertices.data(), *const end = vertices + f.last;
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

// ---- merge ------------------------------------------------------------------------------------

int Snapper::compare(const Edge& e, const Edge& f) const {
    if (e.b != f.b)
        return e.b < f.b ? -1 : 1;
    if (e.chordCount() != f.chordCount())
        return e.chordCount() < f.chordCount() ? -1 : 1;
    const auto p = set_.chain(e), q = set_.chain(f);
    const auto [i, j] = std::mismatch(p.begin(), p.end(), q.begin());
    return i == p.end() ? 0 : *i < *j ? -1 : 1;
}

/// Sorts the edges; equal ones become one with their changes added, and those without any change
/// vanish.
void Snapper::mergeEqual() {
    order_.resize(set_.edges.size());
    for (std::uint32_t i = 0; i < order_.size(); ++i)
        order_[i] = {sortKey(set_.edges[i].a), i};
    sortByKey(order_, spareOrder_, [](const Place& p) { return p.a; });
    nextEdges_.clear();
    for (std::size_t i = 0; i < order_.size();) {
        std::size_t end = i + 1;
        while (end < order_.size() && order_[end].a == order_[i].a)
            ++end;
        if (end > i + 1)
            std::sort(order_.begin() + std::ptrdiff_t(i), order_.begin() + std::ptrdiff_t(end),
                      [&](const Place& p, const Place& q) {
                          const int c = compare(set_.edges[p.edge], set_.edges[q.edge]);
                          return c != 0 ? c < 0 : p.edge < q.edge;
                      });
        while (i < end) {
            Edge e = set_.edges[order_[i].edge];
            const std::size_t first = i++;
            while (i < end && compare(set_.edges[order_[i].edge], e) == 0)
                ++i;
            if (i > first + 1)
                addChanges(e, {order_.data() + first, i - first});
            if (e.changeCount > 0)
                nextEdges_.push_back(e);
        }
    }
    set_.edges.swap(nextEdges_);
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
