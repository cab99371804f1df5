#include "compiler/fit/fit.hpp"

#include <algorithm>

#include <vtm/limits/limits.hpp>
#include "compiler/lower/pairs.hpp"

namespace vtm::compiler {
namespace {

constexpr double extent = asset::leafExtent;

std::array<std::uint16_t, 2> toSteps(Pair p) {
    const IntPair steps = toIntegers(p);
    return {static_cast<std::uint16_t>(steps[0]), static_cast<std::uint16_t>(steps[1])};
}

}  // namespace

const FittedLeaf& Fitter::run(const Square& square, const PlanarLeaf& leaf, double tolerance) {
    square_ = square;
    scale_ = extent / square.side;
    tolerance_ = tolerance * scale_;
    leaf_.pieces.clear();
    leaf_.corners = leaf.corners;
    chains_.link(leaf, square, scale_);
    cutSlivers();
    for (const Chain& chain : chains_.all) {
        limits::check();
        fit(chain);
    }
    return leaf_;
}

// ---- quantise ---------------------------------------------------------------------------------

Pair Fitter::roundInside(Pair u) {
    return toDoubles(toIntegers(smaller(both(extent - 1), larger(both(1), u + 0.5))));
}

/// The border's coordinates are kept for points on the border.
Pair Fitter::roundEnd(LatticePoint p, std::uint32_t point) const {
    Pair r = roundInside(exact(point));
    if (((p.x | p.y) & 1) == 0)
        return r;
    if (p.x == square_.x0 || p.x == square_.x1())
        r[0] = p.x == square_.x0 ? 0 : extent;
    if (p.y == square_.y0 || p.y == square_.y1())
        r[1] = p.y == square_.y0 ? 0 : extent;
    return r;
}

/// Of point i of a chain; only its ends can lie on the border.
Pair Fitter::rounded(const Chain& chain, std::uint32_t i) const {
    const std::uint32_t point = chain.first + i;
    if (i == 0)
        return roundEnd(chain.start, point);
    return i + 1 == chain.count ? roundEnd(chain.end, point) : roundInside(exact(point));
}

// ---- fit --------------------------------------------------------------------------------------

void Fitter::fit(const Chain& chain) {
    const std::uint32_t last = chain.count - 1;
    Pair a = rounded(chain, 0);
    const Pair end = rounded(chain, last);
    for (std::uint32_t from = 0; from < last;)
        from = emitLongest(chain, from, a, end);
}

/// Emits the longest piece that the fit allows from a, the chain's point `from`; returns its last point,
/// which becomes a. The turn of the chain tells how far it can reach; how far a try was beyond the tolerance,
/// what to try next.
std::uint32_t Fitter::emitLongest(const Chain& chain, std::uint32_t from, Pair& a, Pair end) {
    const double *x = chains_.x.data() + chain.first + from, *y = chains_.y.data() + chain.first + from;
    const std::uint32_t last = chain.count - 1 - from;
    const auto roundedAt = [&](std::uint32_t i) { return i == last ? end : roundInside(Pair{x[i], y[i]}); };
    std::uint32_t good = 1, bad = last + 1;
    PieceFit::Slopes slopes;
    for (std::uint32_t to = last == 1 ? 1 : reach(chain.first + from, last); to > 1 && good + 1 < bad;) {
        const double excess = pieceFit_.run(x, y, to, a, roundedAt(to), tolerance_);
        if (excess <= 1) {
            good = to;
            slopes = pieceFit_.slopes();
            if (bad > last)
                break;
            to = good + (bad - good) / 2;
        } else {
            bad = to;
            to = static_cast<std::uint32_t>(to / excess);
            if (to <= good)
                to = good + (bad - good) / 2;
        }
    }
    const Pair b = roundedAt(good);
    if (a[0] != b[0] || a[1] != b[1])  // else shorter than half a step: no area
        leaf_.pieces.push_back({toSteps(a), toSteps(b), slopes.a, slopes.b, chain.left, chain.right});
    a = b;
    return from + good;
}

/// The last point before the chain turns more than slopes allow, of 1 .. last from point `from`. The slopes
/// of the first and the last chord over the chord of all are looked at. The curve's own slopes at its ends
/// are larger than those of n chords by n / (n - 1), if it bends evenly.
std::uint32_t Fitter::reach(std::uint32_t from, std::uint32_t last) const {
    const double *x = chains_.x.data() + from, *y = chains_.y.data() + from;
    const double firstX = x[1] - x[0], firstY = y[1] - y[0];
    // Of points to and to + 1.
    const auto areFlat = [&](std::uint32_t to) {
        const double count = to;
        const Pair n{count, count + 1},
            maximum = maxSlope * (n - 0.5), wholeX = load(x + to) - x[0], wholeY = load(y + to) - y[0],
            lastX = load(x + to) - load(x + to - 1), lastY = load(y + to) - load(y + to - 1),
            acrossFirst = wholeX * firstY - wholeY * firstX, acrossLast = wholeX * lastY - wholeY * lastX;
        return (n * magnitude(acrossFirst) <= maximum * (wholeX * firstX + wholeY * firstY)) &
               (n * magnitude(acrossLast) <= maximum * (wholeX * lastX + wholeY * lastY));
    };
    last = std::min(last, LocalPoints::maxChords);
    if (areFlat(last)[0])
        return last;
    for (std::uint32_t to = 2; to < last; to += 2) {
        const PairMask flat = areFlat(to);
        if (!flat[0])
            return to - 1;
        if (!flat[1] || to + 1 == last)
            return to;
    }
    return last - 1;
}

}  // namespace vtm::compiler
