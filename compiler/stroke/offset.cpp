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

#include "compiler/stroke/offset.hpp"

#include <algorithm>
#include <numbers>

#include <glm/geometric.hpp>

#include "compiler/stroke/bend.hpp"
#include "compiler/stroke/chords.hpp"
#include "compiler/stroke/stretch.hpp"

namespace vtm::compiler::stroke {

void Side::lineTo(Point to, double gap) {
    if (glm::distance(to, end()) > gap)
        addLine(to);
}

void Side::addLines(const double* x, const double* y, int count) {
    const std::size_t before = ends.size();
    ends.resize(before + std::size_t(count));
    Point* const points = ends.data() + before;
    for (std::size_t i = 0; i < std::size_t(count); ++i)
        points[i] = {x[i], y[i]};
}

void Side::cubicTo(Point c1, Point c2, Point to) {
    curves.push_back({ends.size(), c1, c2});
    ends.push_back(to);
}

void Side::append(const Side& next) {
    for (const Curve& c : next.curves)
        curves.push_back({ends.size() + c.edge, c.c1, c.c2});
    ends.insert(ends.end(), next.ends.begin(), next.ends.end());
}

Side reversed(const Side& side) {
    const std::size_t count = side.ends.size();
    Side result{side.end(), std::vector<Point>(count), {}};
    for (std::size_t i = 0; i < count; ++i)
        result.ends[count - 1 - i] = i > 0 ? side.ends[i - 1] : side.start;
    for (std::size_t i = side.curves.size(); i-- > 0;)
        result.curves.push_back({count - 1 - side.curves[i].edge, side.curves[i].c2, side.curves[i].c1});
    return result;
}

namespace {

/// A curve that is tighter than the radius by less than this share of the tolerance counts as gentle:
/// offset and evolute are no further apart than that, and circles stroked up to their centre are not
/// chopped up by the ripple of their cubics.
constexpr double tightShare = 0.25;

constexpr Span wholeCurve{0, 1, Bend::Gentle};

/// Where the curve is hardly tighter than the radius and all of its inner offset stays within the tolerance
/// of a chord, what winds backward there is hidden, too: circles stroked up to their centre.
bool hidesBackwardOffsets(const Cubic& c, const OffsetOptions& o, const std::vector<Span>& spans) {
    constexpr double hardly = 1.05;  // the offset is a twentieth as long as the curve: samples see all of it
    const Stretch whole(c, wholeCurve);
    return std::all_of(spans.begin(), spans.end(),
                       [&](const Span& span) {
                           const double inner = span.bend == Bend::Left ? o.radius : -o.radius;
                           return span.bend == Bend::Gentle ||
                                  isChord(OffsetCurve{whole, inner, false}.samples(0, 1), o.tolerance);
                       }) &&
           isGentle(bends(c, {o.radius, hardly, 0}));
}

/// Whether a tight stretch turns by so little, or is tighter than the radius by so little, that each branch
/// of the evolute is a straight edge: it strays from its chord by no more than a quarter of its length times
/// its turn.
bool isFold(const Cubic& c, const Span& span, const OffsetOptions& o) {
    constexpr double maxTurn = std::numbers::pi / 4;
    const double turn = turnOf(c, span);
    if (turn > maxTurn)
        return false;
    const Stretch stretch(c, span);
    return turn * Evolute(c, stretch, span.bend == Bend::Left ? o.radius : -o.radius, o).depth() <=
           4 * o.straight();
}

double slackOf(const OffsetOptions& o) { return 1 + tightShare * o.tolerance / o.radius; }

/// The curve in stretches that are gentle, folds, or tight with monotone curvature and little turn.
std::vector<Span> classify(const Cubic& c, const OffsetOptions& o) {
    const double smallTurn = gapShare * o.tolerance / o.radius;
    std::vector<Span> spans = withoutSmallTurns(c, bends(c, {o.radius, slackOf(o), smallTurn}), smallTurn);
    if (isGentle(spans) || hidesBackwardOffsets(c, o, spans))
        return {wholeCurve};
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
        contour.append(reversed(evolute));
        contours.push_back(bend == Bend::Left ? contour : reversed(contour));
        bend = Bend::Gentle;
    }
};

class Offsetter {
public:
    Offsetter(const Cubic& curve, const OffsetOptions& options, Ribbon& ribbon)
        : curve_(curve), o_(options), ribbon_(ribbon) {}

    void run() {
        if (isSurelyGentle(curvature(curve_), o_.radius, slackOf(o_)))  // most are, at once
            return gentle({curve_, wholeCurve}, wholeCurve);
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
        appendFit({stretch, distance, backward}, o_.tolerance, side);
    }
    /// The offset of a tight stretch, whose radius of curvature is no larger than `radius`.
    void turning(const Stretch& stretch, double distance, double radius, bool backward, Side& side) const {
        side.lineTo(stretch.offset(0, distance).at, gapShare * o_.tolerance);
        if (!(o_.chords.distance > 0 && appendChords(stretch, distance, radius, chordTolerance(), side)))
            fit(stretch, distance, backward, side);
    }

    void gentle(const Stretch& stretch, const Span& span) {
        if (o_.chords.distance > 0) {
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
        appendChords(curve_, span.t0, span.t1, distance, chordTolerance(), side);
    }
    ChordTolerance chordTolerance() const {
        const double more = (1 - tightShare - gapShare) * o_.tolerance;
        return {o_.chords.distance + more, o_.chords.area};
    }

    void tight(const Stretch& stretch, const Span& span) {
        const bool left = span.bend == Bend::Left;
        const double inner = left ? o_.radius : -o_.radius;
        Side& innerSide = left ? ribbon_.left : ribbon_.right;
        const Evolute evolute(curve_, stretch, inner, o_);
        turning(stretch, -inner, o_.radius + evolute.largestRadius(), false,
                left ? ribbon_.right : ribbon_.left);
        const double gap = gapShare * o_.tolerance;
        if (span.isFold) {
            innerSide.lineTo(evolute.tip(), gap);
            innerSide.lineTo(stretch.offset(1, inner).at, gap);
        } else {
            innerSide.lineTo(evolute.at(0), gap);
            if (hidesChord(stretch, evolute))
                innerSide.lineTo(evolute.at(1), gap);
            else
                evolute.append(innerSide);
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
            beyond_ = {bend, {evolute.at(0), {}, {}}, {evolute.at(0), {}, {}}};
        turning(stretch, inner, o_.radius, true, beyond_.offset);
        evolute.append(beyond_.evolute);
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
