/// \file
/// A stretch of a curve as strokes run through it, its offset, and its evolute: the centres of its curvature,
/// from which on its offset runs backward.
#pragma once

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "compiler/stroke/bend.hpp"
#include "compiler/stroke/fit.hpp"
#include "compiler/stroke/offset.hpp"

namespace vtm::compiler::stroke {

/// A stretch of a curve, which must outlive it, by a parameter u in [0, 1]: even in t where the curve is
/// gentle, even in the tangent's angle where it is tight (the offsets' arc length follows the angle there).
class Stretch {
public:
    Stretch(const Cubic& c, const Span& span) : c_(c), powers_(c), span_(span) {
        if (span.bend == Bend::Gentle)
            return;
        start_ = tangentAt(span.t0);
        end_ = tangentAt(span.t1);
        turn_ = angleBetween(start_, end_);
        velocity_ = velocityOver(c, span.t0, span.t1);
    }

    double parameter(double u) const {
        if (span_.bend == Bend::Gentle && u > 0 && u < 1)
            return span_.t0 + (span_.t1 - span_.t0) * u;
        return place(u).t;
    }
    /// A place of a tight one, or an end: the curve's parameter and, of tight ones, its tangent.
    struct Place {
        double t;
        Point along;
    };
    Place place(double u) const {
        if (u <= 0 || u >= 1)
            return u <= 0 ? Place{span_.t0, start_} : Place{span_.t1, end_};
        const Point along = rotate(start_, turn_ * u);
        return {whereTangent(along), along};
    }
    double lengthBound() const {
        const Cubic piece = geometry::part(c_, span_.t0, span_.t1);
        return glm::distance(piece.p0, piece.p1) + glm::distance(piece.p1, piece.p2) +
               glm::distance(piece.p2, piece.p3);
    }
    /// By how much a tight one turns; negative to the right.
    double turn() const { return turn_; }
    Point startTangent() const { return start_; }  ///< of a tight one
    Point point(double u) const { return pointAt(parameter(u)); }
    /// By the curve's parameter.
    Point pointAt(double t) const { return c_.at(t); }
    Point tangentAt(double t) const { return stroke::tangentAt(c_, t); }
    Sample offset(double u, double distance) const {
        const double t = parameter(u);
        const Point velocity = powers_.velocity(t);
        const bool isInside = t > 0 && t < 1 && velocity != Point{0, 0};
        const Point along = isInside ? unit(velocity) : tangentAt(t);
        const Point at = isInside ? powers_.at(t) : pointAt(t);
        return {at + perp(along) * distance, along};
    }
    /// Of a tight one, where its tangent has this direction, a unit vector between those of its ends.
    Point offsetWhere(Point direction, double distance) const {
        return powers_.at(whereTangent(direction)) + perp(direction) * distance;
    }

private:
    /// γ' × direction is quadratic and changes its sign once: with Bernstein coefficients a, b, c over
    /// the stretch, x = t / (1 - t) is the positive root of c x² + 2b x + a.
    double whereTangent(Point direction) const {
        const double sign = turn_ > 0 ? -1 : 1;  // so that a < 0 < c
        const double a = sign * cross(velocity_[0], direction), b = sign * cross(velocity_[1], direction),
                     c = sign * cross(velocity_[2], direction);
        const double root = std::sqrt(std::max(0.0, b * b - a * c));
        const double share = b > 0 ? -a / (-a + b + root) : (root - b) / (root - b + c);
        return span_.t0 + (span_.t1 - span_.t0) * std::clamp(share, 0.0, 1.0);
    }

    const Cubic& c_;
    const PowerForm powers_;
    Span span_;
    // Of tight ones.
    Point start_{0, 0}, end_{0, 0};  ///< tangents
    double turn_ = 0;
    std::array<Point, 3> velocity_{};
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

/// Goes on to where the offset begins, and with it.
void appendFit(const OffsetCurve& curve, double tolerance, Side& side);

/// Over u in [0, 1], as the stretch, which must outlive it. A chain of parabolas: between two normals that
/// differ by at most 45°, both end tangents of the evolute are the normals themselves, and they meet between
/// curve and offset, in the control point.
class Evolute {
public:
    /// The radius is positive if the stretch bends to the left.
    Evolute(const Cubic& c, const Stretch& stretch, double signedRadius, const OffsetOptions& options);

    Point at(double u) const;
    bool isTighterAtEnd() const;
    /// Where the stretch is tightest.
    Point tip() const { return at(tightest()); }
    /// How far it comes from the offset.
    double depth() const;
    /// The largest radius of curvature, where that is monotone or the stretch is a fold.
    double largestRadius() const;

    /// Goes on with it, from its start on, where the side has come to within the tolerance.
    void append(Side& side) const;

private:
    struct Parabola;
    struct Place;

    Place place(double u) const;
    void append(const Place& from, const Place& to, int depth, Side& side) const;
    Point meeting(const Place& from, const Place& to) const;
    double tightest() const;
    double radiusAt(double t) const;

    Curvature curvature_;
    const Stretch& stretch_;
    double radius_, tolerance_, straight_;
};

}  // namespace vtm::compiler::stroke
