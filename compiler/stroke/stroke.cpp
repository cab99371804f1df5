// A stroke is the union of ribbons (stroke_offset.cpp), one for each segment, of join wedges and of caps.
// All of them are emitted as one contour for an open subpath (right side, cap, left side back, cap) and as
// two for a closed one. Winding numbers are additive over chains of edges: at a vertex the inner side
// runs through the vertex itself, along the ends of both ribbons, so the contour is exactly the sum of the
// ribbons', wedges' and caps' boundaries. Each of these is wound the same way and counts its covers
// without a negative part, so the sum is positive on their union and zero elsewhere, which is what
// non-zero filling needs. No inner join can open a hole.
//
// Between two lines the detour through the vertex may be cut off where the inner offsets cross: that
// takes one cover from the kite between crossing and vertex. The kite lies in both lines' rectangles, and
// as it may reach no further than half of each line, two kites of one line do not meet: a point in m kites
// lies in at least 2m rectangles and stays covered. The same holds between chords of offsets that stand for
// curves: a kite lies in both chords' parts of the ribbons.

#include <vtm/compiler/stroke.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <span>
#include <utility>

#include <glm/geometric.hpp>

#include <vtm/compiler/compile.hpp>
#include <vtm/limits/limits.hpp>
#include "compiler/stroke/chord_joins.hpp"
#include "compiler/stroke/chords.hpp"
#include "compiler/stroke/near.hpp"
#include "compiler/stroke/offset.hpp"
#include "compiler/stroke/subpath.hpp"
#include "compiler/stroke/thin_chords.hpp"

namespace vtm::compiler {

namespace stroke {
namespace {

using scene::Cap;
using scene::Join;
using scene::StrokeStyle;

// Shares of the tolerance: errors of arcs turned into cubics, of offsets fitted to them, and of joins
// left out because they are too small; round joins and caps take the place of the first two.
constexpr double arcShare = 0.3, fitShare = 0.6, joinShare = gapShare, roundShare = 1 - joinShare;

/// Directions closer than this are the same whatever the tolerance: control points do not resolve more.
constexpr double sameDirection = 1e-9;

/// Mitres are no longer than this many widths: longer ones come of angles that the directions do not
/// resolve.
constexpr double longestMitre = 1 / sameDirection;

/// Beyond this, products of six lengths (the slope of the curvature) overflow.
constexpr double largestSize = 1e48;

/// Tolerances are raised to this share of the coordinates: finer fits would chase rounding errors.
constexpr double finestShare = 1e-11;
/// Near a box, where coordinates are no larger than the stroke is wide: a thousand roundings.
constexpr double finestShareNear = 1e-13;

/// Hairlines are as exact as this share of their width, so that they keep their coverage to a sixteenth.
constexpr double hairlineShare = 1.0 / 32;

Point endPoint(const Segment& s) { return s.curve.p3; }

class Outliner {
public:
    Outliner(const StrokeStyle& style, double tolerance, ChordTolerance chords, ContourSink& out)
        : style_(style),
          tolerance_(tolerance),
          radius_(style.width / 2),
          miterLimit_(std::min(style.miterLimit, longestMitre)),
          chords_(chords),
          thin_(radius_, chords),
          out_(out) {}

    void add(const Subpath& subpath) {
        if (subpath.segments.empty())
            dot(subpath);
        else
            ribbon(subpath);
    }

    /// Emits all but the right sides of rings.
    void finish() {
        out_.sidesEnd();
        for (Side& contour : later_)
            emit(contour);
    }

private:
    void dot(const Subpath& subpath) {
        if (style_.cap == Cap::Butt)
            return;
        const Point side = perp(subpath.direction) * radius_;
        Side contour{subpath.at - side, {}, {}};
        cap(contour, subpath.at, subpath.direction);
        cap(contour, subpath.at, -subpath.direction);
        later_.push_back(std::move(contour));
    }

    void ribbon(const Subpath& subpath) {
        ribbon_.left.clear();
        ribbon_.right.clear();
        ribbon_.beyond.clear();
        const auto& segments = subpath.segments;
        const Point first = segments.front().curve.p0,
                    side = perp(startTangent(segments.front().curve)) * radius_;
        ribbon_.left.start = first + side;
        ribbon_.right.start = first - side;
        for (std::size_t i = 0; i < segments.size(); ++i) {
            limits::check();
            if (i > 0)
                joinSegments(segments[i - 1], segments[i]);
            sides(segments[i]);
            if (const ChordJoin join = std::exchange(join_, {}); chords_.distance > 0)
                shorten(join, chords_, joinShare * tolerance_);
        }
        subpath.closed ? closeRing(subpath) : closeEnds(subpath);
        std::move(ribbon_.beyond.begin(), ribbon_.beyond.end(), std::back_inserter(later_));
    }

    void sides(const Segment& segment) {
        if (segment.straight) {
            // Even where it is too short beside the radius to move the offset: joins may lengthen it.
            const Point side = perp(endTangent(segment.curve)) * radius_;
            ribbon_.left.addLine(endPoint(segment) + side);
            ribbon_.right.addLine(endPoint(segment) - side);
        } else if (thin_.isThin()) {
            thinSides(segment.curve);
        } else if (segment.circle) {
            circularSides(segment.curve, *segment.circle);
        } else {
            appendOffsets(segment.curve, {radius_, tolerance_ * fitShare, showsBeyond(), chords_}, ribbon_);
        }
    }

    // --- thin strokes --------------------------------------------------------------------------

    /// The offsets of a curve's chords meet where their angles are halved.
    void thinSides(const Cubic& curve) {
        const std::span<const Point> points = thin_.of(curve);
        Point along = startTangent(curve);
        double before = 0;
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            const Point way = points[i + 1] - points[i];
            const double length = glm::length(way);
            if (length == 0)  // of a loop that is too short to show
                continue;
            const Point next = way / length;
            if (i > 0)
                thinJoin(points[i], along, next, std::min(before, length));
            else
                thinEnd(points[i], along, next);
            along = next;
            before = length;
        }
        const Point tangent = endTangent(curve), side = perp(tangent) * radius_;
        thinEnd(curve.p3, along, tangent);
        ribbon_.left.addLine(curve.p3 + side);
        ribbon_.right.addLine(curve.p3 - side);
    }
    /// Of two chords, with these directions, of which the shorter one is so long. As long as no chord's inner
    /// side runs backward, its part of the ribbon is wound like the others.
    void thinJoin(Point at, Point before, Point after, double length) {
        const double cosine = glm::dot(before, after), sine = std::abs(cross(before, after));
        if (!(cosine > 0 && 2 * radius_ * sine <= (1 + cosine) * length))
            return thinCorner(at, before, after, length);
        const Point offset = crossing(perp(before), perp(after));
        ribbon_.left.addLine(at + offset);
        ribbon_.right.addLine(at - offset);
    }
    /// Where a curve turns at once, as beside a cusp, in less than a chord.
    void thinEnd(Point at, Point before, Point after) {
        if (glm::dot(before, after) < 1 - thin_.turn() * thin_.turn())
            thinCorner(at, before, after, 0);
    }
    /// Where a curve is tighter than the radius: the normal sweeps a disc's sectors there, on both sides.
    void thinCorner(Point at, Point before, Point after, double length) {
        const Corner corner{at, before, after, angleBetween(before, after), true, true, length, Join::Round};
        go(ribbon_.left, at + perp(before) * radius_);
        go(ribbon_.right, at - perp(before) * radius_);
        outerJoin(corner);
        innerJoin(corner);
        if (showsBeyond())
            sweepBeyond(corner);
    }
    /// Round caps and joins cover what lies beyond evolutes (stroke_offset.cpp).
    bool showsBeyond() const { return style_.cap != Cap::Round || style_.join != Join::Round; }

    /// The offsets of a circle are circles, its evolute is the centre.
    void circularSides(const Cubic& curve, const Circle& circle) {
        const Point from = unit(curve.p0 - circle.center), to = unit(curve.p3 - circle.center);
        const double angle = angleBetween(from, to), outer = circle.radius + radius_,
                     inner = circle.radius - radius_;
        Side &innerSide = angle > 0 ? ribbon_.left : ribbon_.right,
             &outerSide = angle > 0 ? ribbon_.right : ribbon_.left;
        arc(outerSide, circle.center, from * outer, angle);
        if (inner > joinShare * tolerance_)
            return arc(innerSide, circle.center, from * inner, angle);
        go(innerSide, circle.center);
        if (inner < -tolerance_ && showsBeyond())
            ribbon_.beyond.push_back(sector(circle.center, from * inner, angle));
    }

    Side sector(Point center, Point from, double angle) const {
        Side contour{center, {}, {}};
        go(contour, center + from);
        arc(contour, center, from, angle);
        go(contour, center);
        return angle > 0 ? contour : reversed(contour);
    }

    void closeRing(const Subpath& subpath) {
        joinSegments(subpath.segments.back(), subpath.segments.front());
        join_ = {};
        // The join may have cut the first line, too.
        ribbon_.left.start = ribbon_.left.end();
        ribbon_.right.start = ribbon_.right.end();
        emit(ribbon_.right);
        later_.push_back(reversed(ribbon_.left));
    }

    void closeEnds(const Subpath& subpath) {
        Side& contour = ribbon_.right;
        const Point from = subpath.segments.front().curve.p0, to = endPoint(subpath.segments.back());
        const Point ahead = endTangent(subpath.segments.back().curve);
        go(contour, to - perp(ahead) * radius_);
        cap(contour, to, ahead);
        const Side back = reversed(ribbon_.left);
        go(contour, back.start);
        contour.append(back);
        cap(contour, from, -startTangent(subpath.segments.front().curve));
        later_.push_back(contour);
    }

    // --- joins ---------------------------------------------------------------------------------

    struct Corner {
        Point at, before, after;  ///< the vertex, unit tangents
        double angle;             ///< between these
        bool isAfterLine, isBeforeLine;
        double length;  ///< of the shorter of two lines; 0 if one of both is none
        Join join;

        double sign() const { return angle > 0 ? 1 : -1; }
    };

    void joinSegments(const Segment& a, const Segment& b) {
        const Point before = endTangent(a.curve), after = startTangent(b.curve);
        const double angle = angleBetween(before, after);
        if (std::abs(angle) <= std::max(sameDirection, joinShare * tolerance_ / radius_))
            return smoothJoin(b);
        const double length = a.straight && b.straight ? std::min(extent(a.curve), extent(b.curve)) : 0;
        const Corner corner{endPoint(a), before,     after,  angle,
                            a.straight,  b.straight, length, b.afterCusp ? Join::Round : style_.join};
        join_ = {corner.before, corner.after, {}, {}};
        join_.tip = outerJoin(corner);
        join_.detour = innerJoin(corner);
        if (b.afterCusp && showsBeyond())
            sweepBeyond(corner);
    }
    /// The other half of the disc that the normal sweeps.
    void sweepBeyond(const Corner& c) {
        ribbon_.beyond.push_back(sector(c.at, perp(c.before) * (c.sign() * radius_), c.angle));
    }

    /// Where a curve is tight up to its end its inner side has come to the evolute, not to the offset.
    void smoothJoin(const Segment& b) {
        const Point at = b.curve.p0, side = perp(startTangent(b.curve)) * radius_;
        go(ribbon_.left, at + side);
        go(ribbon_.right, at - side);
    }

    Detour innerJoin(const Corner& c) {
        Side& inner = c.angle > 0 ? ribbon_.left : ribbon_.right;
        const Point n0 = perp(c.before) * c.sign(), n1 = perp(c.after) * c.sign();
        if (kiteFits(c)) {
            inner.ends.back() = c.at + crossing(n0, n1);
            return {};
        }
        const std::size_t first = inner.ends.size();
        go(inner, c.at);
        go(inner, c.at + n1 * radius_);
        return inner.ends.size() == first + 2 ? Detour{&inner, first} : Detour{};
    }

    /// Where two offset lines with these unit normals meet, seen from the vertex: n0 + n1 has the length
    /// 2cos(θ/2), and the crossing lies r/cos(θ/2) away along it.
    Point crossing(Point n0, Point n1) const {
        const Point sum = n0 + n1;
        return sum * (2 * radius_ / glm::dot(sum, sum));
    }

    bool kiteFits(const Corner& c) const {
        const double angle = std::abs(c.angle);
        return c.length > 0 && 2 * radius_ * std::max(std::sin(angle), std::tan(angle / 2)) <= c.length;
    }

    Tip outerJoin(const Corner& c) {
        Side& outer = c.angle > 0 ? ribbon_.right : ribbon_.left;
        const Point n0 = perp(c.before) * -c.sign(), n1 = perp(c.after) * -c.sign();
        const Point from = c.at + n0 * radius_, to = c.at + n1 * radius_;
        const double cosine = std::cos(c.angle / 2);
        if (c.join != Join::Round && c.join != Join::Bevel && 1 <= miterLimit_ * cosine) {
            extendTo(outer, c, from, c.at + crossing(n0, n1));
            const Tip tip{&outer, outer.ends.size() - 1, !c.isAfterLine, !c.isBeforeLine};
            if (!c.isBeforeLine)  // a line goes on from the mitre's tip
                go(outer, to);
            return tip;
        }
        if (c.join == Join::MiterClip) {
            // The clipping line crosses the bisector at miterLimit·r (SVG 2 section 13.5.4).
            const double along = radius_ * (miterLimit_ - cosine) / std::abs(std::sin(c.angle / 2));
            extendTo(outer, c, from, from + c.before * along);
            go(outer, to - c.after * along);
            if (!c.isBeforeLine)
                go(outer, to);
            return {};
        }
        go(outer, from);
        if (c.join == Join::Round)
            arc(outer, c.at, n0 * radius_, c.angle);
        go(outer, to);
        return {};
    }

    /// A line before the mitre goes on to its tip without a vertex in between.
    void extendTo(Side& outer, const Corner& c, Point from, Point tip) const {
        if (c.isAfterLine) {
            outer.ends.back() = tip;
        } else {
            go(outer, from);
            go(outer, tip);
        }
    }

    // --- caps ----------------------------------------------------------------------------------

    /// From the right of `ahead` to its left, round the end `at`.
    void cap(Side& contour, Point at, Point ahead) const {
        const Point side = perp(ahead) * radius_, forward = ahead * radius_;
        if (style_.cap == Cap::Round) {
            arc(contour, at, -side, std::numbers::pi);
        } else if (style_.cap == Cap::Square) {
            go(contour, at - side + forward);
            go(contour, at + side + forward);
        }
        go(contour, at + side);
    }

    void go(Side& side, Point to) const { side.lineTo(to, joinShare * tolerance_); }

    /// Goes to the arc's start first, if need be.
    void arc(Side& side, Point center, Point from, double angle) const {
        go(side, center + from);
        const double sagitta = glm::length(from) * (1 - std::cos(angle / 2)),
                     maximum = tolerance_ * roundShare;
        if (sagitta <= maximum && std::abs(angle) < std::numbers::pi / 2)
            return go(side, center + rotate(from, angle));
        if (chords_.distance > 0 &&
            appendArcChords(center, from, angle, {chords_.distance + maximum, chords_.area}, side))
            return;
        for (const Cubic& c : circleArc(center, from, angle, maximum))
            side.cubicTo(c.p1, c.p2, c.p3);
    }

    // --- output --------------------------------------------------------------------------------

    /// Close draws the last edge where that is a line; a rest that the tolerance hides is taken away.
    void emit(Side& contour) {
        limits::check();
        auto& ends = contour.ends;
        if (!ends.empty() && glm::distance(contour.end(), contour.start) <= tolerance_ * joinShare)
            ends.back() = contour.start;
        if (contour.endsStraight() && ends.back() == contour.start)
            ends.pop_back();
        out_.start(contour.start);
        const std::span<const Point> edges(ends);
        std::size_t done = 0;
        for (const Side::Curve& curve : contour.curves) {
            out_.lines(edges.subspan(done, curve.edge - done));
            out_.cubic(curve.c1, curve.c2, edges[curve.edge]);
            done = curve.edge + 1;
        }
        out_.lines(edges.subspan(done));
        out_.close();
    }

    const StrokeStyle& style_;
    double tolerance_, radius_, miterLimit_;
    ChordTolerance chords_;
    ThinChords thin_;
    ContourSink& out_;
    Ribbon ribbon_;
    ChordJoin join_;  ///< of the last two segments
    std::vector<Side> later_;
};

/// `chords`: of OffsetOptions. Whether all is rings.
bool outline(const scene::Path& path, const scene::StrokeStyle& style, double tolerance,
             ChordTolerance chords, ContourSink& contours) {
    const double size = largestCoordinate(path) + style.width;
    if (!(size <= largestSize))
        throw LimitError("stroke: coordinates or width beyond 1e48");
    tolerance = std::max(std::min(tolerance, hairlineShare * style.width), finestShare * size);
    if (chords.distance > 0)
        chords.distance = std::max(chords.distance, finestShare * size);
    Outliner outliner(style, tolerance, chords, contours);
    std::size_t dashes = 0;
    bool isRings = style.dashes.empty();
    for (const Subpath& subpath : subpaths(path, tolerance * arcShare)) {
        if (style.dashes.empty()) {
            isRings &= subpath.closed;
            outliner.add(subpath);
            continue;
        }
        for (const Subpath& piece : dash(subpath, style, dashes))
            outliner.add(piece);
    }
    outliner.finish();
    return isRings;
}

/// The strokes' subpaths, dashes if it has any; of these what reaches the box.
std::vector<Subpath> subpathsNear(const PathBox& box, const scene::Path& path, const StrokeStyle& style,
                                  double tolerance, bool& isRings) {
    std::vector<Subpath> near;
    std::size_t dashes = 0;
    const auto add = [&](const Subpath& subpath) {
        isRings &= subpath.closed;
        if (!nearParts(subpath, style, box, tolerance, near))
            isRings = false;
    };
    for (const Subpath& subpath : subpaths(path, tolerance * arcShare)) {
        if (style.dashes.empty()) {
            add(subpath);
            continue;
        }
        isRings = false;
        for (const Subpath& piece : dash(subpath, style, dashes, DashPrecision::Finest))
            add(piece);
    }
    return near;
}

bool outlineNear(const PathBox& box, const scene::Path& path, const StrokeStyle& style, double tolerance,
                 ChordTolerance chords, ContourSink& contours) {
    if (!(largestCoordinate(path) + style.width <= largestSize))
        throw LimitError("stroke: coordinates or width beyond 1e48");
    bool isRings = true;
    tolerance = std::min(tolerance, hairlineShare * style.width);
    const std::vector<Subpath> near = subpathsNear(box, path, style, tolerance, isRings);
    double size = style.width;
    for (const Subpath& subpath : near)
        size = std::max(size, style.width + largestCoordinate(subpath));
    const double finest = finestShareNear * size;
    if (chords.distance > 0)
        chords.distance = std::max(chords.distance, finest);
    Outliner outliner(style, std::max(tolerance, finest), chords, contours);
    for (const Subpath& subpath : near)
        outliner.add(subpath);
    outliner.finish();
    return isRings;
}

scene::Path outlineAsPath(const scene::Path& path, const scene::StrokeStyle& style, double tolerance,
                          ChordTolerance chords) {
    ContourPath contours;
    outline(path, style, tolerance, chords, contours);
    return std::move(contours.path);
}

}  // namespace
}  // namespace stroke

scene::Path strokeOutline(const scene::Path& path, const scene::StrokeStyle& style, double tolerance) {
    return stroke::outlineAsPath(path, style, tolerance, 0);
}

scene::Path strokeOutlineOfChords(const scene::Path& path, const scene::StrokeStyle& style, double tolerance,
                                  ChordTolerance chordTolerance) {
    return stroke::outlineAsPath(path, style, tolerance, chordTolerance);
}

bool strokeContours(const scene::Path& path, const scene::StrokeStyle& style, double tolerance,
                    ChordTolerance chordTolerance, ContourSink& contours) {
    return stroke::outline(path, style, tolerance, chordTolerance, contours);
}

bool strokeContoursNear(const PathBox& box, const scene::Path& path, const scene::StrokeStyle& style,
                        double tolerance, ChordTolerance chordTolerance, ContourSink& contours) {
    return stroke::outlineNear(box, path, style, tolerance, chordTolerance, contours);
}

bool hasSampledOffsets(const scene::Path& path) {
    return std::any_of(path.begin(), path.end(), [](const scene::Command& command) {
        if (const auto* arc = std::get_if<scene::ArcTo>(&command))
            return std::abs(arc->radii.x) != std::abs(arc->radii.y);
        return std::holds_alternative<scene::QuadTo>(command) ||
               std::holds_alternative<scene::CubicTo>(command);
    });
}

}  // namespace vtm::compiler
