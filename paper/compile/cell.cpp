#include "paper/compile/cell.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "paper/compile/fit.hpp"
#include "paper/compile/runs.hpp"
#include "paper/evaluate.hpp"

namespace vtm::paper {

namespace {

/// More chords than this are split without a look, which costs the square of their number.
constexpr std::size_t chordsToLookAt = 256;

/// On the last level pairs are chosen from this many pieces.
constexpr std::size_t piecesToPairUp = 12;

/// Points a side of the grid, and pieces whose sides are looked at: together at most 64 points.
constexpr int gridSide = 6;
constexpr std::size_t piecesToProbe = 4;

/// Points at which a choice is compared with the truth; a bit each.
using Bits = std::uint64_t;

struct Probes {
    std::vector<Point> points;
    Bits inside = 0, all = 0;

    void add(const Outline& outline, const CellTask& task, Point p) {
        const Bits bit = Bits(1) << points.size();
        points.push_back(p);
        all |= bit;
        if (isInside(outline, task, p))
            inside |= bit;
    }
    int mismatches(Bits classified) const { return std::popcount((classified ^ inside) & all); }
};

double distanceTo(const Piece& piece, Point p) {
    const Value f = implicitValue(piece, p);
    return f.value / glm::length(f.gradient);
}

/// Off every simple fraction, so that borders of drawings do not fall on it.
constexpr double gridShift = 0.4871;

void addGrid(Probes& probes, const Outline& outline, const CellTask& task, const std::vector<Piece>& pieces,
             double tooNear) {
    for (int j = 0; j < gridSide; ++j)
        for (int i = 0; i < gridSide; ++i) {
            const Point p((i + gridShift) / gridSide, (j + gridShift) / gridSide);
            const bool clear = std::ranges::all_of(
                pieces, [&](const Piece& piece) { return std::abs(distanceTo(piece, p)) > tooNear; });
            if (clear)
                probes.add(outline, task, p);
        }
}

/// Points on both sides of the piece.
void addSides(Probes& probes, const Outline& outline, const CellTask& task, const Piece& piece,
              double offset) {
    const Point a = Point(piece.a[0], piece.a[1]) / cellExtent;
    const Point chord = Point(piece.b[0], piece.b[1]) / cellExtent - a;
    for (const double s : {0.15, 0.5, 0.85}) {
        const Point onChord = a + chord * s;
        const Value f = implicitValue(piece, onChord);
        // f is v - t(u): moving by -f along AB⊥ reaches the curve exactly.
        const Point onCurve = onChord - f.value * Point(-chord.y, chord.x);
        const Point aside = f.gradient * (offset / glm::length(f.gradient));
        probes.add(outline, task, onCurve + aside);
        probes.add(outline, task, onCurve - aside);
    }
}

/// What a piece classifies as inside at the probes.
Bits classified(const Piece& piece, const Probes& probes) {
    Bits bits = 0;
    for (std::size_t i = 0; i < probes.points.size(); ++i)
        if (implicitValue(piece, probes.points[i]).value > 0)
            bits |= Bits(1) << i;
    return bits;
}

struct Choice {
    Cell cell;
    int mismatches = std::numeric_limits<int>::max();

    void offer(const Cell& candidate, int wrong) {
        if (wrong < mismatches)
            *this = {candidate, wrong};
    }
};

Piece turned(const Piece& piece, bool turn) { return turn ? reversed(piece) : piece; }

void offerPair(Choice& choice, const Probes& probes, const std::array<Piece, 2>& p, Bits first, Bits second) {
    for (const bool turnFirst : {false, true})
        for (const bool turnSecond : {false, true}) {
            const Bits f = turnFirst ? ~first : first, s = turnSecond ? ~second : second;
            Cell cell{{turned(p[0], turnFirst), turned(p[1], turnSecond)}, 2, Operator::Intersection};
            choice.offer(cell, probes.mismatches(f & s));
            cell.combine = Operator::Union;
            choice.offer(cell, probes.mismatches(f | s));
        }
}

Choice choose(const std::vector<Piece>& pieces, const Probes& probes) {
    std::vector<Bits> bits;
    for (const Piece& piece : pieces)
        bits.push_back(classified(piece, probes));
    Choice choice;
    for (std::size_t i = 0; i < pieces.size(); ++i)
        for (std::size_t j = i + 1; j < pieces.size(); ++j)
            offerPair(choice, probes, {pieces[i], pieces[j]}, bits[i], bits[j]);
    for (std::size_t i = 0; i < pieces.size(); ++i)
        for (const bool turn : {false, true})
            choice.offer({{turned(pieces[i], turn), {}}, 1, Operator::Intersection},
                         probes.mismatches(turn ? ~bits[i] : bits[i]));
    return choice;
}

std::vector<Piece> piecesOf(const std::vector<Run>& runs, double tolerance, std::size_t limit) {
    std::vector<Piece> pieces;
    for (const Run& run : runs) {
        if (pieces.size() > limit)
            break;
        for (const Piece& piece : fitPieces(run, tolerance, limit - pieces.size()))
            pieces.push_back(piece);
    }
    return pieces;
}

CellDecision solid(bool inside, bool approximated) {
    return {CellDecision::Kind::Solid, inside, {}, approximated};
}

/// By most of the grid's points.
CellDecision solidByMajority(const Outline& outline, const CellTask& task, bool approximated) {
    Probes probes;
    addGrid(probes, outline, task, {}, 0);
    return solid(2 * std::popcount(probes.inside) > std::popcount(probes.all), approximated);
}

}  // namespace

ClippedChord clip(const Chord& chord, const CellFrame& frame) {
    return clip(chord, frame.min, frame.min + frame.side);
}

ClippedChord clip(const Chord& chord, Point min, Point max) {
    ClippedChord cut{0, 1};
    const Point d = chord.b - chord.a;
    for (int axis = 0; axis < 2; ++axis) {
        const double low = min[axis] - chord.a[axis], high = max[axis] - chord.a[axis];
        if (d[axis] == 0) {
            if (low > 0 || high < 0)
                return {};
            continue;
        }
        const double one = low / d[axis], other = high / d[axis];
        cut.from = std::max(cut.from, std::min(one, other));
        cut.to = std::min(cut.to, std::max(one, other));
    }
    return cut;
}

CellDecision decide(const Outline& outline, const CellTask& task, double tolerance, bool isLastLevel) {
    if (task.chords.empty())
        return solid(outline.isInside(task.winding), false);
    if (task.chords.size() > chordsToLookAt)
        return isLastLevel ? solidByMajority(outline, task, true) : CellDecision{};
    constexpr double roundingSteps = 3, sideOffset = 4, largestOffset = 1.0 / 32;
    const double inCell = std::max(tolerance / CellFrame(task).side, roundingSteps / cellExtent);
    const double offset = std::min(sideOffset * inCell, largestOffset);
    const std::size_t limit = isLastLevel ? piecesToPairUp : 2;
    const auto pieces = piecesOf(visibleRuns(outline, task, offset), inCell, limit);
    if (pieces.empty())
        return solidByMajority(outline, task, false);
    if (pieces.size() > 2 && !isLastLevel)
        return {};
    Probes probes;
    for (std::size_t i = 0; i < std::min(pieces.size(), piecesToProbe); ++i)
        addSides(probes, outline, task, pieces[i], offset);
    addGrid(probes, outline, task, pieces, 2 * inCell);
    const Choice choice = choose(pieces, probes);
    const bool right = choice.mismatches == 0 && pieces.size() <= 2;
    if (!right && !isLastLevel)
        return {};
    return {CellDecision::Kind::Cell, false, choice.cell, !right};
}

}  // namespace vtm::paper
