#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include <glm/geometric.hpp>

#include <vtm/compiler/compile.hpp>
#include <vtm/compiler/stroke.hpp>
#include <vtm/limits/limits.hpp>
#include "compiler/stroke/subpath.hpp"

namespace vtm::compiler::stroke {

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
