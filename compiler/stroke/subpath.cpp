#include "compiler/stroke/subpath.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include <glm/geometric.hpp>

#include <vtm/compiler/compile.hpp>
#include <vtm/compiler/stroke.hpp>
#include <vtm/limits/limits.hpp>
#include "compiler/stroke/roots.hpp"

namespace vtm::compiler::stroke {

namespace {

/// Points closer than this share of the path's largest coordinate are the same: it is what the
/// importer's transforms leave of equal points. A longer rest of a closed polygon would be a segment
/// with a join of its own.
constexpr double coincidence = 1e-12;

/// Control points closer to the chord than this share of the extent make a straight segment; ten
/// times finer than the directions that tangents resolve.
constexpr double straightness = 1e-10;

/// A speed that falls below this share of the extent is a cusp. A curve that turns faster than that
/// has its tip within 1e-18 of the extent.
constexpr double cuspSpeed = 1e-9;

/// Straight and, as it has no cusp, without turning back.
bool isStraight(const Cubic& c) {
    const Point chord = c.p3 - c.p0;
    const double length = glm::length(chord), size = extent(c);
    return length > 0 && std::abs(cross(chord, c.p1 - c.p0)) <= straightness * size * length &&
           std::abs(cross(chord, c.p2 - c.p0)) <= straightness * size * length;
}

/// Whether the directions of the controls keep within half a turn, so that the speed cannot vanish inside.
bool runsForward(const Cubic& c) {
    const Point chord = c.p3 - c.p0;
    const double a = glm::dot(c.p1 - c.p0, chord), b = glm::dot(c.p2 - c.p1, chord),
                 d = glm::dot(c.p3 - c.p2, chord);
    return a >= 0 && b > 0 && d >= 0;
}

Roots<3> cusps(const Cubic& c) {
    if (runsForward(c))
        return {};
    const double minimum = cuspSpeed * extent(c);
    Roots<3> result;
    for (const double t : rootsInside(derivative(powers(curvature(c).speedSquared))))
        if (glm::length(c.derivative(t)) <= minimum)
            result.add(t);
    return result;
}

class Builder {
public:
    Builder(double tolerance, double coincident) : tolerance_(tolerance), coincident_(coincident) {}

    void operator()(const scene::MoveTo& c) {
        finish(false);
        start_ = at_ = c.to;
    }
    void operator()(const scene::LineTo& c) { add(geometry::straightCubic(at_, c.to)); }
    void operator()(const scene::QuadTo& c) { add(geometry::raised(at_, c.control, c.to)); }
    void operator()(const scene::CubicTo& c) { add({at_, c.control1, c.control2, c.to}); }
    void operator()(const scene::ArcTo& c) {
        drawn_ = true;
        const Arc arc = ellipticalArc(at_, c, tolerance_);
        for (const Cubic& piece : arc.pieces)
            arc.circle ? addSmooth(piece, false, arc.circle) : add(piece);
        at_ = c.to;
    }
    void operator()(const scene::Close&) {
        add(geometry::straightCubic(at_, start_));
        finish(true);
        at_ = start_;
    }

    std::vector<Subpath> take() {
        finish(false);
        return std::move(result_);
    }

private:
    void finish(bool closed) {
        if (drawn_)
            result_.push_back({std::move(segments_), closed, start_});
        segments_.clear();
        drawn_ = false;
    }

    void add(const Cubic& c) {
        drawn_ = true;
        at_ = c.p3;
        if (extent(c) <= coincident_)
            return;
        double from = 0;
        Cubic rest = c;
        for (const double t : cusps(c)) {
            // Both controls at a cusp lie in it but for rounding, whose direction would be a tangent.
            Cubic before = geometry::part(c, from, t);
            before.p1 = rest.p1 == rest.p0 ? before.p0 : before.p1;
            before.p2 = before.p3;
            addSmooth(before, from > 0);
            rest = geometry::part(c, t, 1);
            rest.p1 = rest.p0;
            from = t;
        }
        addSmooth(rest, from > 0);
    }

    void addSmooth(const Cubic& c, bool afterCusp, std::optional<Circle> circle = {}) {
        if (extent(c) <= coincident_)
            return;
        const bool straight = isStraight(c);
        segments_.push_back(
            {straight ? geometry::straightCubic(c.p0, c.p3) : c, straight, circle, afterCusp});
    }

    double tolerance_, coincident_;
    std::vector<Subpath> result_;
    std::vector<Segment> segments_;
    Point start_{0, 0}, at_{0, 0};
    bool drawn_ = false;
};

}  // namespace

double largestCoordinate(const scene::Path& path) {
    double largest = 0;
    const auto see = [&](Point p) { largest = std::max({largest, std::abs(p.x), std::abs(p.y)}); };
    for (const scene::Command& command : path) {
        if (const auto* move = std::get_if<scene::MoveTo>(&command))
            see(move->to);
        else if (const auto* line = std::get_if<scene::LineTo>(&command))
            see(line->to);
        else if (const auto* quad = std::get_if<scene::QuadTo>(&command))
            see(quad->control), see(quad->to);
        else if (const auto* cubic = std::get_if<scene::CubicTo>(&command))
            see(cubic->control1), see(cubic->control2), see(cubic->to);
        else if (const auto* arc = std::get_if<scene::ArcTo>(&command))
            see(arc->to);
    }
    return largest;
}

double largestCoordinate(const Subpath& subpath) {
    double largest = std::max(std::abs(subpath.at.x), std::abs(subpath.at.y));
    if (!subpath.segments.empty())
        largest = 0;
    for (const Segment& s : subpath.segments)
        for (const Point p : {s.curve.p0, s.curve.p1, s.curve.p2, s.curve.p3})
            largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
    return largest;
}

std::vector<Subpath> subpaths(const scene::Path& path, double tolerance) {
    Builder builder(tolerance, coincidence * largestCoordinate(path));
    for (const scene::Command& command : path) {
        limits::check();
        std::visit(builder, command);
    }
    return builder.take();
}

namespace {

/// A dash that ends within this share of the subpath's length from a vertex ends at the vertex:
/// rounding must not carry it round a corner.
constexpr double vertexSnap = 1e-9;
/// So where lengths are as exact as doubles can be, of which many have been added up.
constexpr double finestVertexSnap = 1e-13;
/// Of a quadrature that sums up doubles.
constexpr double finestLengthError = 1e-14;

double segmentLength(const Segment& s, double error) {
    return s.straight ? glm::distance(s.curve.p0, s.curve.p3) : arcLength(s.curve, 0, 1, error);
}

double cutAt(const Segment& s, double from, double length, double whole, double error) {
    return s.straight ? std::min(1.0, from + length / whole)
                      : parameterAtLength(s.curve, from, length, error);
}

/// Where in the pattern the pen is.
class Pattern {
public:
    Pattern(const std::vector<double>& lengths, double phase) : lengths_(lengths), left_(lengths.front()) {
        const double period = std::accumulate(lengths.begin(), lengths.end(), 0.0);
        double skip = std::fmod(phase, period);
        if (skip < 0)
            skip += period;
        while (skip >= left_ && skip > 0) {
            skip -= left_;
            next();
        }
        left_ -= skip;
    }

    bool drawing() const { return index_ % 2 == 0; }
    double left() const { return left_; }
    void use(double length) { left_ -= length; }
    void next() {
        index_ = (index_ + 1) % lengths_.size();
        left_ = lengths_[index_];
    }

private:
    const std::vector<double>& lengths_;
    std::size_t index_ = 0;
    double left_;
};

class Dasher {
public:
    Dasher(const Subpath& subpath, const scene::StrokeStyle& style, double snap, double error)
        : subpath_(subpath), pattern_(style.dashes, style.dashPhase), snap_(snap), error_(error) {}

    std::vector<Subpath> run(const std::vector<double>& lengths) {
        const bool startsDrawing = pattern_.drawing();
        for (std::size_t i = 0; i < lengths.size(); ++i)
            walk(subpath_.segments[i], lengths[i]);
        if (!dash_.empty())
            finish(startsDrawing);
        return std::move(result_);
    }

private:
    void walk(const Segment& segment, double length) {
        double t = 0, rest = length;
        while (pattern_.left() <= rest + snap_) {
            limits::check();
            const bool atEnd = pattern_.left() >= rest - snap_;
            const double cut = atEnd ? 1 : cutAt(segment, t, pattern_.left(), length, error_);
            draw(segment, t, cut);
            endDash(segment, cut);
            rest -= pattern_.left();
            pattern_.next();
            t = cut;
            if (atEnd)
                return;
        }
        draw(segment, t, 1);
        pattern_.use(rest);
    }

    void draw(const Segment& segment, double from, double to) {
        if (!pattern_.drawing() || from >= to)
            return;
        const bool whole = from == 0 && to == 1;
        dash_.push_back({whole ? segment.curve : geometry::part(segment.curve, from, to), segment.straight,
                         segment.circle, segment.afterCusp && from == 0});
    }

    void endDash(const Segment& segment, double t) {
        if (pattern_.drawing())
            result_.push_back({std::move(dash_), false, segment.curve.at(t), tangentAt(segment.curve, t)});
        cut_ = true;
        dash_.clear();
    }

    /// What is left over the subpath's end goes on over the start of a closed one.
    void finish(bool startsDrawing) {
        if (!subpath_.closed || !startsDrawing) {
            result_.push_back({std::move(dash_), false, subpath_.at});
        } else if (!cut_) {
            result_.push_back(subpath_);
        } else {
            auto& first = result_.front().segments;
            first.insert(first.begin(), dash_.begin(), dash_.end());
        }
    }

    const Subpath& subpath_;
    Pattern pattern_;
    double snap_, error_;
    std::vector<Segment> dash_;
    std::vector<Subpath> result_;
    bool cut_ = false;
};

bool hasNoGap(const std::vector<double>& dashes) {
    for (std::size_t i = 1; i < dashes.size(); i += 2)
        if (dashes[i] > 0)
            return false;
    return true;
}

void checkCount(std::size_t& count, double length, const std::vector<double>& dashes) {
    const double period = std::accumulate(dashes.begin(), dashes.end(), 0.0);
    const double more = std::ceil(length / period) * double(dashes.size() / 2) + 1;
    if (!(double(count) + more <= double(maxDashes)))
        throw LimitError("stroke: more than " + std::to_string(maxDashes) + " dashes in one path");
    count += std::size_t(more);
}

}  // namespace

std::vector<Subpath> dash(const Subpath& subpath, const scene::StrokeStyle& style, std::size_t& count,
                          DashPrecision precision) {
    if (subpath.segments.empty() || hasNoGap(style.dashes))
        return {subpath};
    std::vector<double> lengths;
    const bool isFinest = precision == DashPrecision::Finest;
    const double error = isFinest ? finestLengthError : usualLengthError;
    std::transform(subpath.segments.begin(), subpath.segments.end(), std::back_inserter(lengths),
                   [&](const Segment& s) { return segmentLength(s, error); });
    const double length = std::accumulate(lengths.begin(), lengths.end(), 0.0);
    checkCount(count, length, style.dashes);
    const double snap = (isFinest ? finestVertexSnap : vertexSnap) * length;
    return Dasher(subpath, style, snap, error).run(lengths);
}

}  // namespace vtm::compiler::stroke
