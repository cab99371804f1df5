#include "conformance/reference/outline/stroke_line.hpp"

#include <iterator>
#include <numeric>

#include <vtm/limits/limits.hpp>
#include "conformance/reference/reference.hpp"

namespace vtm::reference {
namespace {

/// A curve that stays within this share of its coordinates is a point. Sums of decimal steps meet their
/// start again only so far: the closing line that is left over, 1e-14 long and in any direction, would
/// get mitres on both ends.
constexpr double coincidence = 1e-10;
/// A dash with no more than this share of its closed subpath still to draw where that ends, ends there:
/// lengths are sums, and only rounding would carry it over the start.
constexpr double endSlack = 1e-9;

bool hasLength(const Run& run) {
    const Point p = run.front().at;
    const double near = coincidence * std::max(std::abs(p.x), std::abs(p.y));
    return std::any_of(run.begin(), run.end(), [&](const Sample& s) { return length(s.at - p) > near; });
}

StrokeLine strokeLineOf(const Subpath& subpath, const Fineness& fineness) {
    StrokeLine line{{}, subpath.closed};
    for (const Curve& curve : subpath.curves) {
        Run run = flatten(curve, fineness);
        if (hasLength(run))
            line.runs.push_back(std::move(run));
    }
    if (line.runs.empty()) {
        const Sample dot{subpath.start, {1, 0}};
        line = {{{dot, dot}}, false};
    }
    return line;
}

Sample between(const Sample& a, const Sample& b, double share) {
    const Vector direction = a.direction + share * (b.direction - a.direction);
    const double l = length(direction);
    return {a.at + share * (b.at - a.at), l > 0 ? direction / l : b.direction};
}

struct Interval {
    double begin, end;
};

/// The share of the chord from a to b inside the box (Liang and Barsky 1984); empty if begin > end.
Interval visibleShare(Point a, Point b, const Box& box) {
    Interval share{0, 1};
    for (int axis = 0; axis < 2; ++axis) {
        const double d = b[axis] - a[axis];
        const double toMin = box.min[axis] - a[axis], toMax = box.max[axis] - a[axis];
        if (d == 0) {
            if (toMin > 0 || toMax < 0)
                return {1, 0};
            continue;
        }
        share.begin = std::max(share.begin, std::min(toMin / d, toMax / d));
        share.end = std::min(share.end, std::max(toMin / d, toMax / d));
    }
    return share;
}

/// Walks along lines with the pattern's dashes and gaps.
class Dasher {
public:
    Dasher(const scene::StrokeStyle& style, const Fineness& fineness)
        : pattern_(style.dashes),
          period_(std::accumulate(pattern_.begin(), pattern_.end(), 0.0)),
          phase_(std::fmod(style.dashPhase, period_)),
          fineness_(fineness) {
        if (phase_ < 0)
            phase_ += period_;
    }

    /// False once there are too many dashes.
    bool walk(const StrokeLine& line) {
        if (isDot(line)) {
            dashes_.push_back(line);
            return dashes_.size() <= maxDashes;
        }
        index_ = 0;
        left_ = pattern_[0];
        walked_ = 0;
        advance(phase_);
        const bool startsOn = on();
        const std::size_t first = dashes_.size();
        start(line.runs.front().front());
        for (const Run& run : line.runs) {
            continueWith(run.front());
            for (std::size_t i = 0; i + 1 < run.size() && dashes_.size() <= maxDashes; ++i)
                walkChord(run[i], run[i + 1]);
        }
        const bool runsOn = line.closed && startsOn && on() && left_ > endSlack * walked_;
        finish();
        if (runsOn)
            joinEnds(first);
        return dashes_.size() <= maxDashes;
    }

    std::vector<StrokeLine> take() { return std::move(dashes_); }

private:
    /// Dots are drawn wherever the pattern stands.
    static bool isDot(const StrokeLine& line) {
        return line.runs.size() == 1 && line.runs.front().size() == 2 &&
               line.runs.front().front().at == line.runs.front().back().at;
    }
    bool on() const { return index_ % 2 == 0; }

    void nextElement() {
        index_ = (index_ + 1) % pattern_.size();
        left_ = pattern_[index_];
    }

    /// Moves on in the pattern alone. What ends here is over, except a dash of no length.
    void advance(double distance) {
        for (; distance > 0 && distance >= left_; nextElement())
            distance -= left_;
        left_ -= distance;
    }

    void start(const Sample& at) {
        if (on())
            current_.runs = {{at}};
    }
    /// A new run of the same dash: there is a join here.
    void continueWith(const Sample& at) {
        if (current_.runs.empty())
            return;
        if (current_.runs.back().size() > 1)
            current_.runs.push_back({at});
        else
            current_.runs.back() = {at};
    }
    void extendTo(const Sample& at) {
        if (!current_.runs.empty())
            current_.runs.back().push_back(at);
    }
    void finish() {
        if (current_.runs.empty())
            return;
        // A dash that ends at a vertex ends before it, without a join.
        if (current_.runs.size() > 1 && current_.runs.back().front().at == current_.runs.back().back().at)
            current_.runs.pop_back();
        if (current_.runs.back().size() < 2)
            current_.runs.back().push_back(current_.runs.back().front());
        dashes_.push_back(std::move(current_));
        current_ = {};
    }

    /// The last dash of a closed line goes on with the one that began at its start, `first`.
    void joinEnds(std::size_t first) {
        if (dashes_.size() == first + 1) {  // the only one: it has gone all the way round
            dashes_.back().closed = true;
            return;
        }
        StrokeLine last = std::move(dashes_.back());
        dashes_.pop_back();
        if (!isDot(dashes_[first]))
            std::move(dashes_[first].runs.begin(), dashes_[first].runs.end(), std::back_inserter(last.runs));
        dashes_[first] = std::move(last);
    }

    void walkChord(const Sample& a, const Sample& b) {
        const double l = length(b.at - a.at);
        walked_ += l;
        const auto [begin, end] = visibleShare(scene::apply(fineness_.toPixels, a.at),
                                               scene::apply(fineness_.toPixels, b.at), fineness_.view);
        if (!(begin <= end) || !std::isfinite(l)) {
            skip(a, b, 0, l, l);
            return;
        }
        skip(a, b, 0, begin * l, l);
        walkPart(a, b, begin * l, end * l, l);
        skip(a, b, end * l, l, l);
    }

    /// Along a chord of length l from `from` to `to`, lengths both.
    void walkPart(const Sample& a, const Sample& b, double from, double to, double l) {
        while (left_ < to - from && dashes_.size() <= maxDashes) {
            limits::check();
            from += left_;
            const Sample cut = between(a, b, from / l);
            extendTo(cut);
            finish();
            nextElement();
            start(cut);
        }
        left_ -= to - from;
        if (to > 0)
            extendTo(to == l ? b : between(a, b, to / l));
    }

    /// Out of view whole periods make no dashes.
    void skip(const Sample& a, const Sample& b, double from, double to, double l) {
        if (!(to - from > period_)) {
            walkPart(a, b, from, to, l);
            return;
        }
        extendTo(between(a, b, from / l));
        finish();
        advance(std::fmod(to - from, period_));
        start(between(a, b, to / l));
    }

    const std::vector<double>& pattern_;
    double period_, phase_;
    const Fineness& fineness_;
    std::size_t index_ = 0;
    double left_ = 0;     ///< of the element at `index_`
    double walked_ = 0;   ///< along this line
    StrokeLine current_;  ///< the dash being made; no runs in a gap
    std::vector<StrokeLine> dashes_;
};

}  // namespace

std::vector<StrokeLine> strokeLinesOf(const scene::Path& path, const Fineness& fineness) {
    std::vector<StrokeLine> lines;
    for (const Subpath& subpath : subpaths(path))
        if (subpath.closed || !subpath.curves.empty())
            lines.push_back(strokeLineOf(subpath, fineness));
    return lines;
}

std::optional<std::vector<StrokeLine>> dash(const std::vector<StrokeLine>& lines,
                                            const scene::StrokeStyle& style, const Fineness& fineness) {
    Dasher dasher(style, fineness);
    for (const StrokeLine& line : lines)
        if (!dasher.walk(line))
            return std::nullopt;
    return dasher.take();
}

}  // namespace vtm::reference
