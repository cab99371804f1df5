#include "compiler/fit/fit.hpp"

#include <algorithm>
#include <cmath>

#include <vtm/asset/asset.hpp>
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

namespace {

std::int16_t stored(double slope) {
    const double scaled = slope * double{asset::slopeScale};
    return static_cast<std::int16_t>(scaled < 0 ? scaled - 0.5 : scaled + 0.5);
}

/// Places points 0 .. last; whether the points rise along the chord.
bool place(LocalPoints& points, const double* x, const double* y, std::uint32_t last, Pair a, Pair along) {
    const Pair ax = both(a[0]), ay = both(a[1]), alongX = both(along[0]), alongY = both(along[1]);
    PairMask rises{-1, -1};
    Pair before{};
    for (std::uint32_t i = 1; i < last; i += 2) {
        const Pair dx = load(x + i) - ax, dy = load(y + i) - ay, s = dx * alongX + dy * alongY;
        store(&points.along[i], s);
        store(&points.across[i], alongX * dy - dx * alongY);
        rises &= previous(before, s) < s;
        before = s;
    }
    points.along[0] = points.across[0] = 0;
    points.along[last] = points.along[last + 1] = 1;  // then a step of no length
    points.across[last] = points.across[last + 1] = 0;
    return (rises[0] & rises[1]) != 0 && points.along[last - 1] < 1;
}

/// The slopes that come closest to the means of the chords by some of the points 1 .. last - 1: chords lie on
/// the inner side of points by up to a quarter of what these stray from the line of their neighbours, on
/// average by half of that.
Pair minSquares(const LocalPoints& points, std::uint32_t last) {
    // Normal equations of t(s_i) = mA p_i + mB q_i; a whisper of regularisation keeps the case of one inner
    // point solvable and prefers small slopes.
    constexpr double whisper = 1e-9;
    constexpr std::uint32_t maxSamples = 8;
    constexpr double inwards = 1.0 / 8;
    const std::uint32_t stride = (last - 1 + maxSamples) / maxSamples;
    Pair pp{}, pq{}, qq{}, pt{}, qt{};
    for (std::uint32_t i = 1 + (stride - 1) / 2; i < last; i += 2 * stride) {
        // With no second point the end stands in, which counts for nothing.
        const std::uint32_t k = std::min(i + stride, last);
        const Pair before{points.along[i - 1], points.along[k - 1]}, s{points.along[i], points.along[k]},
            after{points.along[i + 1], points.along[k + 1]},
            yBefore{points.across[i - 1], points.across[k - 1]}, y{points.across[i], points.across[k]},
            yAfter{points.across[i + 1], points.across[k + 1]};
        const Pair off = yBefore + (yAfter - yBefore) * (s - before) / (after - before) - y;
        const Pair t = y + inwards * off, h = s * (1 - s), p = h * (1 - s), q = -h * s;
        pp += p * p, pq += p * q, qq += q * q, pt += p * t, qt += q * t;
    }
    const auto sum = [](Pair v) { return v[0] + v[1]; };
    const double a = sum(pp) + whisper, b = sum(pq), c = sum(qq) + whisper, d = sum(pt), e = sum(qt),
                 whole = a * c - b * b;
    return Pair{d * c - e * b, e * a - d * b} / whole;
}

/// How far the chain may be from the piece t(s) = s (1 - s) (a (1 - s) - b s), as a share of its chord.
/// Between two points a step ds apart the chain's chord lies above that of the curve by no more than at one
/// of them, and the curve below its own chord by at most max(t'') ds² / 8, above it by at most max(-t'') ds²
/// / 8, where t'' = 2 (a + b) (3 s - 1) - 2 a is linear.
double stray(const LocalPoints& points, Pair m, std::uint32_t last) {
    const double turn = m[0] + m[1], bend0 = -(turn + m[0]) / 4;
    Pair high{}, low{}, s0{}, off0{}, bend0s = both(bend0);  // bend: t'' / 8
    for (std::uint32_t i = 1; i <= last; i += 2) {
        const Pair s = load(&points.along[i]), turned = turn * s, bend = bend0 + 0.75 * turned,
                   off = load(&points.across[i]) - s * (m[0] - s * (turn + m[0] - turned));
        const Pair step = s - previous(s0, s), square = step * step, offBefore = previous(off0, off),
                   bendBefore = previous(bend0s, bend);
        const Pair below = larger(larger(bendBefore, bend), Pair{}),
                   above = smaller(smaller(bendBefore, bend), Pair{});
        high = larger(high, below * square + larger(offBefore, off));
        low = smaller(low, above * square + smaller(offBefore, off));
        s0 = s, off0 = off, bend0s = bend;
    }
    const Pair worst = larger(high, -low);
    return std::max(worst[0], worst[1]);
}

}  // namespace

/// Least squares over some of the points between, in the basis of the chord; then the bound, which is a
/// proof (`stray`).
double PieceFit::run(const double* x, const double* y, std::uint32_t last, Pair a, Pair b, double tolerance) {
    constexpr double beyond = 2;
    const Pair ab = b - a;
    const double length2 = ab[0] * ab[0] + ab[1] * ab[1];
    if (length2 == 0 || !place(local_, x, y, last, a, ab / length2))
        return beyond;
    const Pair m = minSquares(local_, last);
    const double steepest = std::max(std::abs(m[0]), std::abs(m[1]));
    if (!(steepest <= maxSlope))
        return std::max(steepest / maxSlope, 1.01);
    slopes_ = {stored(m[0]), stored(m[1])};
    const double maximum = tolerance / std::sqrt(length2),
                 worst = stray(local_, Pair{double(slopes_.a), double(slopes_.b)} / double{asset::slopeScale},
                               last);
    return worst <= maximum ? 1 : std::clamp(std::sqrt(std::sqrt(worst / maximum)), 1.01, beyond);
}

}  // namespace vtm::compiler
