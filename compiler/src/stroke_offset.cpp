// Each ribbon is the image of (t, s) -> γ(t) + s·n(t) for |s| <= r. Its Jacobian is |γ'|(1 - κs): where
// |κ|·r <= 1 it never turns negative, and the two true offsets bound the ribbon with the winding number
// that counts how often a point is covered. Where κr > 1 the offset on the inner side runs backward
// from s = 1/κ on, and its loops would count negatively. There the inner side follows the evolute
// s = 1/κ instead of the offset: the Jacobian stays non-negative, and the ribbon's winding stays the
// number of covers. What lies beyond the evolute is covered with a Jacobian that is negative throughout,
// so it makes a contour of its own, wound the other way round. Such a contour is rarely needed. At a point
// P beyond the evolute of γ(t) the distance to the curve has a maximum at t; towards either end it falls
// to a minimum, the foot of another normal that covers P already, or to the end itself, which covers P if
// its cap or join is round. An end farther than 2r from γ(t) is farther from P than γ(t) is: the minimum
// comes before.
//
// The evolute is a chain of parabolas: between two normals that differ by at most 45°, both end tangents
// of the evolute are the normals themselves, and they meet between curve and offset, in the control point.
//
// Where the curve is tightest, the evolute has a cusp, in which one more normal covers the ribbon. Its two
// branches part so slowly that rounding them later, each by itself, may swap them over a long way, and what
// should be covered once more is covered once less: a thread of nothing, deep inside the stroke. So its sides
// are straight as far as may be. A chord of the evolute in place of an arc only adds covers, between the two.
// - With R0 > R1 the radii of curvature at γ(t0) and γ(t1), and E0, E1 their centres, which are no farther
//   apart than R0 - R1: what lies between chord and arc is within R0 <= r of γ(t1), and not nearer to γ(t0).
//   So it is covered if everything within r of the curve is, or if the end beyond γ(t1) is farther than 2r
//   from there, since the nearest point of the curve is then an inner one.
// - Elsewhere it may stick out of the stroke, by no more than the arc's tangents do.
// - A *fold* is a tight stretch of so little turn that this holds from one offset to the other: the inner
//   side goes straight to the cusp and back, as it does at a join. Both ways are equally long, and as their
//   ends differ across them, which rounding in each axis does not reverse, neither does it swap the sides.

#include "compiler/src/stroke_offset.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

#include "compiler/src/stroke_bend.hpp"
#include "compiler/src/stroke_chords.hpp"
#include "compiler/src/stroke_fit.hpp"

namespace vtm::compiler::stroke {

void Side::lineTo(Point to, double gap) {
    if (glm::distance(to, end()) > gap)
        edges.push_back({true, {}, {}, to});
}

Side reversed(const Side& side) {
    Side result{side.end(), {}};
    result.edges.reserve(side.edges.size());
    for (std::size_t i = side.edges.size(); i-- > 0;) {
        const Edge& e = side.edges[i];
        result.edges.push_back({e.straight, e.c2, e.c1, i > 0 ? side.edges[i - 1].to : side.start});
    }
    return result;
}

namespace {

/// A fit is cut at least in two at each level. What is left at the last one, far below the tolerance, is a
/// straight edge.
constexpr int maxFitDepth = 20;

/// A curve that is tighter than the radius by less than this share of the tolerance counts as gentle:
/// offset and evolute are no further apart than that, and circles stroked up to their centre are not
/// chopped up by the ripple of their cubics.
constexpr double tightShare = 0.25;

/// A stretch of a curve by a parameter u in [0, 1]: even in t where the curve is gentle, even in the
/// tangent's angle where it is tight (the offsets' arc length follows the angle there).
class Stretch {
public:
    Stretch(const Cubic& c, const Span& span)
        : c_(c),
          powers_(c),
          span_(span),
          start_(tangentAt(c, span.t0)),
          turn_(angleBetween(start_, tangentAt(c, span.t1))) {}

    double parameter(double u) const {
        if (u <= 0 || u >= 1)
            return u <= 0 ? span_.t0 : span_.t1;
        if (span_.bend == Bend::Gentle)
            return span_.t0 + (span_.t1 - span_.t0) * u;
        return whereTangent(rotate(start_, turn_ * u));
    }
    double lengthBound() const {
        const Cubic piece = part(c_, span_.t0, span_.t1);
        return glm::distance(piece.p0, piece.p1) + glm::distance(piece.p1, piece.p2) +
               glm::distance(piece.p2, piece.p3);
    }
    Point point(double u) const { return pointAt(c_, parameter(u)); }
    Point tangent(double u) const { return tangentAt(c_, parameter(u)); }
    Sample offset(double u, double distance) const {
        const double t = parameter(u);
        const Point velocity = powers_.velocity(t);
        const bool isInside = t > 0 && t < 1 && velocity != Point{0, 0};
        const Point along = isInside ? unit(velocity) : tangentAt(c_, t);
        const Point at = isInside ? powers_.at(t) : pointAt(c_, t);
        return {at + perp(along) * distance, along};
    }

private:
    /// γ' × direction is quadratic and changes its sign once: with Bernstein coefficients a, b, c over
    /// the stretch, x = t / (1 - t) is the positive root of c x² + 2b x + a.
    double whereTangent(Point direction) const {
        const Cubic piece = part(c_, span_.t0, span_.t1);
        const double sign = turn_ > 0 ? -1 : 1;  // so that a < 0 < c
        const double a = sign * cross(piece.p1 - piece.p0, direction),
                     b = sign * cross(piece.p2 - piece.p1, direction),
                     c = sign * cross(piece.p3 - piece.p2, direction);
        const double root = std::sqrt(std::max(0.0, b * b - a * c));
        const double share = b > 0 ? -a / (-a + b + root) : (root - b) / (root - b + c);
        return span_.t0 + (span_.t1 - span_.t0) * std::clamp(share, 0.0, 1.0);
    }

    const Cubic& c_;
    const PowerForm powers_;
    Span span_;
    Point start_;
    double turn_;
};

/// The offset at `distance` to the left, run through along the curve, or against it where the curve is
/// tighter than the distance.
struct OffsetCurve {
    const Stretch& stretch;
    double distance;
    bool backward;

    Samples samples(double u0, double u1) const {
        Samples s;
        for (std::size_t i = 0; i < s.size(); ++i) {
            const double f = double(i) / double(s.size() - 1);
            s[i] = stretch.offset(u0 + (u1 - u0) * f, distance);
            if (backward)
                s[i].tangent = -s[i].tangent;
        }
        return s;
    }
};

/// Where the curve is hardly tighter than the radius and all of its inner offset stays within the tolerance
/// of a chord, what winds backward there is hidden, too: circles stroked up to their centre.
bool hidesBackwardOffsets(const Cubic& c, const OffsetOptions& o, const std::vector<Span>& spans) {
    constexpr double hardly = 1.05;  // the offset is a twentieth as long as the curve: samples see all of it
    const Stretch whole(c, {0, 1, Bend::Gentle});
    return std::all_of(spans.begin(), spans.end(),
                       [&](const Span& span) {
                           const double inner = span.bend == Bend::Left ? o.radius : -o.radius;
                           return span.bend == Bend::Gentle ||
                                  isChord(OffsetCurve{whole, inner, false}.samples(0, 1), o.tolerance);
                       }) &&
           isGentle(bends(c, {o.radius, hardly, 0}));
}

constexpr int maxPieces = 8;

/// How many pieces bring the error of a fit below the tolerance, by its sixth order.
int pieceCount(double error, double tolerance) {
    if (!std::isfinite(error))
        return 2;
    return int(std::clamp(std::ceil(std::pow(error / tolerance, 1.0 / 6)), 2.0, double(maxPieces)));
}

/// Ends of the pieces as shares of the stretch, the first 0. Pieces take equal sums of the square roots of
/// the turns between samples: shorter ones where the curve bends, longer ones where it hardly does. A tenth
/// goes by the parameter alone, so that no piece is without end.
std::array<double, maxPieces + 1> cuts(const Samples& s, int count) {
    constexpr double evenShare = 0.1;
    constexpr std::size_t steps = std::tuple_size_v<Samples> - 1;
    std::array<double, steps + 1> sums{};
    for (std::size_t i = 0; i < steps; ++i)
        sums[i + 1] = sums[i] + std::sqrt(std::abs(cross(s[i].tangent, s[i + 1].tangent)));
    const double even = sums[steps] > 0 ? sums[steps] * evenShare / steps : 1;
    for (std::size_t i = 0; i <= steps; ++i)
        sums[i] += even * double(i);
    std::array<double, maxPieces + 1> result{};
    std::size_t at = 0;
    for (int k = 1; k < count; ++k) {
        const double goal = sums[steps] * k / count;
        while (sums[at + 1] < goal)
            ++at;
        result[std::size_t(k)] = (double(at) + (goal - sums[at]) / (sums[at + 1] - sums[at])) / steps;
    }
    result[std::size_t(count)] = 1;
    return result;
}

void appendFit(const OffsetCurve& curve, double u0, double u1, double tolerance, int depth, Side& side) {
    const Samples samples = curve.samples(u0, u1);
    if (depth == 0 || isChord(samples, tolerance))
        return side.lineTo(samples.back().at, gapShare * tolerance);
    const Fit fit = fitCubic(samples, tolerance);
    if (fit.error <= tolerance)
        return side.cubicTo(fit.cubic.p1, fit.cubic.p2, fit.cubic.p3);
    const int count = pieceCount(fit.error, tolerance);
    const auto shares = cuts(samples, count);
    for (std::size_t i = 0; i < std::size_t(count); ++i)
        appendFit(curve, u0 + (u1 - u0) * shares[i], u0 + (u1 - u0) * shares[i + 1], tolerance, depth - 1,
                  side);
}

/// The evolute of a tight stretch.
class Evolute {
public:
    Evolute(const Cubic& c, const Stretch& stretch, double signedRadius, const OffsetOptions& options)
        : curvature_(curvature(c)),
          stretch_(stretch),
          radius_(signedRadius),
          tolerance_(options.tolerance),
          straight_(options.straight()) {}

    Point at(double u) const { return stretch_.point(u) + normal(u) * centreDistance(u); }

    bool isTighterAtEnd() const { return centreDistance(1) < centreDistance(0); }

    Point tip() const { return at(tightest()); }
    /// How far it comes from the offset.
    double depth() const { return std::abs(radius_) - centreDistance(tightest()); }

    void append(double u0, double u1, int depth, Side& side) const {
        const Parabola arc{at(u0), meeting(u0, u1), at(u1)};
        if (depth == 0 || arc.height() <= straight_)
            return side.lineTo(arc.to, gapShare * tolerance_);
        if (error(arc, u0, u1) > tolerance_) {
            append(u0, (u0 + u1) / 2, depth - 1, side);
            append((u0 + u1) / 2, u1, depth - 1, side);
            return;
        }
        const Cubic c = elevate(arc.from, arc.control, arc.to);
        side.cubicTo(c.p1, c.p2, c.p3);
    }

private:
    struct Parabola {
        Point from, control, to;

        /// Of the triangle, in which the evolute lies, over the chord; if that is short, a side.
        double height() const {
            const Point chord = to - from, side = control - from;
            const double length = glm::length(chord), shorter = glm::length(side);
            return length > 0 ? std::min(shorter, std::abs(cross(chord, side)) / length) : shorter;
        }
    };

    /// Of the ends and some places between.
    double tightest() const {
        constexpr int places = 4;
        double best = 0;
        for (int i = 1; i <= places; ++i)
            if (const double u = double(i) / places; centreDistance(u) < centreDistance(best))
                best = u;
        return best;
    }

    /// Distance of parallel tangents: where the parabola runs along the normal, the evolute touches it.
    double error(const Parabola& arc, double u0, double u1) const {
        double worst = 0;
        for (const double share : {0.25, 0.5, 0.75}) {
            const double u = u0 + (u1 - u0) * share;
            const Point n = normal(u);
            const double a = cross(arc.control - arc.from, n), b = cross(arc.to - arc.control, n);
            const double t = a == b ? 0.5 : std::clamp(a / (a - b), 0.0, 1.0), s = 1 - t;
            const Point on = arc.from * (s * s) + arc.control * (2 * s * t) + arc.to * (t * t);
            worst = std::max(worst, std::abs(cross(on - at(u), n)));
        }
        return worst;
    }

    /// Towards the centre of curvature.
    Point normal(double u) const { return perp(stretch_.tangent(u)) * (radius_ < 0 ? -1.0 : 1.0); }

    double centreDistance(double u) const {
        const double t = stretch_.parameter(u), r = std::abs(radius_);
        const double q = std::max(0.0, bernstein(curvature_.speedSquared, t)), cube = q * std::sqrt(q);
        const double bend = std::abs(bernstein(curvature_.cross, t));
        return cube < r * bend ? cube / bend : (cube > 0 ? r : 0);
    }

    /// Where the normals meet, always between curve and offset.
    Point meeting(double u0, double u1) const {
        const Point n0 = normal(u0), n1 = normal(u1), p0 = stretch_.point(u0);
        const double sine = cross(n0, n1);
        constexpr double parallel =
            1e-9;  // below, rounding moves the crossing by more than the evolute is long
        if (std::abs(sine) < parallel)
            return (at(u0) + at(u1)) / 2.0;
        const double s = cross(stretch_.point(u1) - p0, n1) / sine;
        return p0 + n0 * std::clamp(s, 0.0, std::abs(radius_));
    }

    Curvature curvature_;
    const Stretch& stretch_;
    double radius_, tolerance_, straight_;
};

/// Whether a tight stretch turns by so little, or is tighter than the radius by so little, that each branch
/// of the evolute is a straight edge: it strays from its chord by no more than a quarter of its length times
/// its turn.
bool isFold(const Cubic& c, const Span& span, const OffsetOptions& o) {
    constexpr double mostTurn = std::numbers::pi / 4;
    const double turn = turnOf(c, span);
    if (turn > mostTurn)
        return false;
    const Stretch stretch(c, span);
    return turn * Evolute(c, stretch, span.bend == Bend::Left ? o.radius : -o.radius, o).depth() <=
           4 * o.straight();
}

/// The curve in stretches that are gentle, folds, or tight with monotone curvature and little turn.
std::vector<Span> classify(const Cubic& c, const OffsetOptions& o) {
    const double slack = 1 + tightShare * o.tolerance / o.radius;
    const double smallTurn = gapShare * o.tolerance / o.radius;
    std::vector<Span> spans = withoutSmallTurns(c, bends(c, {o.radius, slack, smallTurn}), smallTurn);
    if (isGentle(spans) || hidesBackwardOffsets(c, o, spans))
        return {{0, 1, Bend::Gentle}};
    for (Span& span : spans)
        span.isFold = span.bend != Bend::Gentle && isFold(c, span, o);
    return cutTight(c, spans, 4 * o.straight() / o.radius);
}

/// What the normals sweep beyond the evolute over consecutive tight stretches.
struct Beyond {
    Bend bend = Bend::Gentle;
    Side offset, evolute;

    void close(std::vector<Side>& contours) {
        if (bend == Bend::Gentle)
            return;
        Side contour = offset;
        contour.lineTo(evolute.end());
        const Side back = reversed(evolute);
        contour.edges.insert(contour.edges.end(), back.edges.begin(), back.edges.end());
        contours.push_back(bend == Bend::Left ? contour : reversed(contour));
        bend = Bend::Gentle;
    }
};

class Offsetter {
public:
    Offsetter(const Cubic& curve, const OffsetOptions& options, Ribbon& ribbon)
        : curve_(curve), o_(options), ribbon_(ribbon) {}

    void run() {
        for (const Span& span : classify(curve_, o_)) {
            if (span.bend != beyond_.bend)
                beyond_.close(ribbon_.beyond);
            const Stretch stretch(curve_, span);
            span.bend == Bend::Gentle ? gentle(stretch, span) : tight(stretch, span);
        }
        beyond_.close(ribbon_.beyond);
    }

private:
    void fit(const Stretch& stretch, double distance, bool backward, Side& side) const {
        side.lineTo(stretch.offset(0, distance).at, gapShare * o_.tolerance);
        appendFit({stretch, distance, backward}, 0, 1, o_.tolerance, maxFitDepth, side);
    }

    void gentle(const Stretch& stretch, const Span& span) {
        if (o_.chords > 0) {
            chords(stretch, span, o_.radius, ribbon_.left);
            chords(stretch, span, -o_.radius, ribbon_.right);
        } else {
            fit(stretch, o_.radius, false, ribbon_.left);
            fit(stretch, -o_.radius, false, ribbon_.right);
        }
    }

    /// Where the curve is a little tighter than the radius, or turns by too little to matter, the offset
    /// turns back by these shares of the tolerance.
    void chords(const Stretch& stretch, const Span& span, double distance, Side& side) const {
        side.lineTo(stretch.offset(0, distance).at, gapShare * o_.tolerance);
        appendChords(curve_, span.t0, span.t1, distance,
                     o_.chords + (1 - tightShare - gapShare) * o_.tolerance, side);
    }

    void tight(const Stretch& stretch, const Span& span) {
        const bool left = span.bend == Bend::Left;
        const double inner = left ? o_.radius : -o_.radius;
        Side& innerSide = left ? ribbon_.left : ribbon_.right;
        fit(stretch, -inner, false, left ? ribbon_.right : ribbon_.left);
        const Evolute evolute(curve_, stretch, inner, o_);
        const double gap = gapShare * o_.tolerance;
        if (span.isFold) {
            innerSide.lineTo(evolute.tip(), gap);
            innerSide.lineTo(stretch.offset(1, inner).at, gap);
        } else {
            innerSide.lineTo(evolute.at(0), gap);
            if (hidesChord(stretch, evolute))
                innerSide.lineTo(evolute.at(1), gap);
            else
                evolute.append(0, 1, maxFitDepth, innerSide);
        }
        if (o_.beyond && !hidesBeyond(stretch))
            sweepBeyond(stretch, evolute, span.bend, inner);
    }

    /// An end lies farther than 2r from all of the stretch, which is no longer than its controls' polygon.
    bool hidesBeyond(const Stretch& stretch) const {
        const Point at = stretch.point(0);
        const double away = std::max(glm::distance(at, curve_.p0), glm::distance(at, curve_.p3));
        return away > 2 * o_.radius + stretch.lengthBound();
    }

    /// The end towards which the curve gets tighter lies farther than 2r from that end of the stretch; or all
    /// that is nearer than r is covered.
    bool hidesChord(const Stretch& stretch, const Evolute& evolute) const {
        const bool forward = evolute.isTighterAtEnd();
        return !o_.beyond ||
               glm::distance(stretch.point(forward ? 1 : 0), forward ? curve_.p3 : curve_.p0) > 2 * o_.radius;
    }

    void sweepBeyond(const Stretch& stretch, const Evolute& evolute, Bend bend, double inner) {
        if (beyond_.bend != bend)
            beyond_ = {bend, {evolute.at(0), {}}, {evolute.at(0), {}}};
        fit(stretch, inner, true, beyond_.offset);
        evolute.append(0, 1, maxFitDepth, beyond_.evolute);
    }

    const Cubic& curve_;
    const OffsetOptions& o_;
    Ribbon& ribbon_;
    Beyond beyond_;
};

}  // namespace

void appendOffsets(const Cubic& curve, const OffsetOptions& options, Ribbon& ribbon) {
    Offsetter(curve, options, ribbon).run();
}

}  // namespace vtm::compiler::stroke
