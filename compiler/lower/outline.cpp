#include "compiler/lower/outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include <glm/common.hpp>

#include <vtm/limits/limits.hpp>
#include "compiler/lower/chords.hpp"
#include "compiler/lower/error_budget.hpp"
#include "compiler/stroke/chords.hpp"
#include "compiler/stroke/near.hpp"

namespace vtm::compiler {
namespace {

using scene::Affine;
using scene::Point;

Point lerp(Point a, Point b, double t) { return a + (b - a) * t; }

/// The directions that a run takes, in x and in y.
class Directions {
public:
    /// Goes on by a step, unless that turns back.
    bool take(LatticePoint from, LatticePoint to) {
        // By signs, without branches, whose outcome is random. Differences fit 31 bits.
        const Coord x = to.x - from.x, y = to.y - from.y;
        const Coord right = right_ | -x, left = left_ | x, up = up_ | -y, down = down_ | y;
        if (((right & left) | (up & down)) < 0)
            return false;
        right_ = right, left_ = left, up_ = up, down_ = down;
        return true;
    }

private:
    Coord right_ = 0, left_ = 0, up_ = 0, down_ = 0;  ///< negative if taken
};

/// Takes points in steps, cuts the polyline at the box, appends runs of chords between even vertices.
class RunSink {
public:
    RunSink(Outlines& outlines, glm::dvec2 min, glm::dvec2 max)
        : points_(outlines.points), runs_(outlines.runs), min_(min), max_(max) {}

    void start(Point p) {
        finish();
        current_ = p;
        beyond_ = sidesBeyond(p);
        points_.push_back(quantise(p));
        contourStart_ = runStart_ = static_cast<std::uint32_t>(points_.size() - 1);
        started_ = true;
    }

    void line(Point to) {
        const unsigned beyond = sidesBeyond(to);
        if ((beyond_ | beyond) == 0)
            emit(nearestEven(to));
        else
            lineOutside(to, beyond);
        current_ = to;
    }

    void lines(std::span<const Point> to) {
        if (beyond_ == 0 && !to.empty() && areInside(to))
            return linesInside(to);
        for (const Point p : to)
            line(p);
    }

    /// Where the line so far and its next points are known to be inside the box.
    void linesInside(std::span<const Point> to) {
        limits::check();
        askFor(to.size());
        const std::size_t before = points_.size();
        points_.resize(before + to.size());
        LatticePoint* const first = points_.data() + before;
        std::transform(to.begin(), to.end(), first, nearestEven);
        LatticePoint *kept = first, from = first[-1];
        Directions taken = taken_;
        for (const LatticePoint& next : std::span(first, to.size())) {
            if (next == from)
                continue;
            if (!taken.take(from, next)) {
                addRun(static_cast<std::uint32_t>(kept - points_.data() - 1));
                taken = {};
                taken.take(from, next);
            }
            from = *kept++ = next;
        }
        points_.resize(std::size_t(kept - points_.data()));
        taken_ = taken;
        current_ = to.back();
    }
    Point current() const { return current_; }
    std::size_t runCount() const { return runs_.size(); }
    /// Whether the line so far ends inside the box and all of the curve lies there.
    bool keepsInside(const Cubic& c) const {
        return beyond_ == 0 && (sidesBeyond(c.p1) | sidesBeyond(c.p2) | sidesBeyond(c.p3)) == 0;
    }
    /// Whether the line so far ends beyond a side of the box beyond which all of the curve lies.
    bool keepsBeyond(const Cubic& c) const {
        return (beyond_ & sidesBeyond(c.p1) & sidesBeyond(c.p2) & sidesBeyond(c.p3)) != 0;
    }

    /// Ends the last contour.
    void finish() {
        if (!started_)
            return;
        emitHeld();
        endRun();
        if (points_.size() - 1 == contourStart_)
            points_.pop_back();  // a point that nothing follows
        else if (isThereAndBack())
            dropContour();
        started_ = false;
    }

private:
    /// Whether the contour is a line and the same line back, as that of a `line` element is: nothing lies
    /// inside.
    bool isThereAndBack() const {
        return points_.size() == contourStart_ + std::size_t{3} && points_.back() == points_[contourStart_];
    }
    void dropContour() {
        points_.resize(contourStart_);
        while (!runs_.empty() && runs_.back().last > contourStart_)
            runs_.pop_back();
    }

    /// One bit each.
    unsigned sidesBeyond(Point p) const {
        return unsigned(p.x < min_.x) | unsigned(p.x > max_.x) << 1 | unsigned(p.y < min_.y) << 2 |
               unsigned(p.y > max_.y) << 3;
    }

    /// To a point beyond these sides, or from one.
    void lineOutside(Point to, unsigned beyond) {
        if ((beyond_ & beyond) != 0) {
            beyond_ &= beyond;
            isHeld_ = true;
            return;
        }
        emitHeld();
        for (const double t : boxCuts(current_, to))
            if (t > 0 && t < 1)
                emit(quantise(lerp(current_, to, t)));
        emit(quantise(to));
        beyond_ = beyond;
    }

    bool areInside(std::span<const Point> points) const {
        Point min = points.front(), max = min;
        for (const Point p : points)
            min = glm::min(min, p), max = glm::max(max, p);
        return (sidesBeyond(min) | sidesBeyond(max)) == 0;
    }

    /// Where the segment meets the four lines of the box, ascending: between two cuts clamping is an
    /// affine map and keeps the segment straight.
    std::array<double, 6> boxCuts(Point a, Point b) const {
        std::array<double, 6> cuts{};
        const Point d = b - a;
        for (int axis = 0; axis < 2; ++axis)
            if (d[axis] != 0) {
                cuts[static_cast<std::size_t>(2 * axis)] = (min_[axis] - a[axis]) / d[axis];
                cuts[static_cast<std::size_t>(2 * axis + 1)] = (max_[axis] - a[axis]) / d[axis];
            }
        std::sort(cuts.begin(), cuts.end());
        return cuts;
    }

    LatticePoint quantise(Point p) const {
        return nearestEven({std::clamp(p.x, min_.x, max_.x), std::clamp(p.y, min_.y, max_.y)});
    }

    /// Of a point in the box, which keeps it within Coord.
    static LatticePoint nearestEven(Point p) {
        constexpr double coarse = 0x1.8p53;  // doubles of that size are two apart
        return {static_cast<Coord>((p.x + coarse) - coarse), static_cast<Coord>((p.y + coarse) - coarse)};
    }

    /// All points from the last one emitted to the current one lie beyond one side: moved onto it, they are
    /// one line.
    void emitHeld() {
        if (isHeld_)
            emit(quantise(current_));
        isHeld_ = false;
    }

    void emit(LatticePoint to) {
        const LatticePoint from = points_.back();
        if (to == from)
            return;
        if (!taken_.take(from, to)) {
            endRun();
            taken_.take(from, to);
        }
        askFor(1);
        points_.push_back(to);
    }

    /// Of the budget, before the vector moves to a larger place.
    void askFor(std::size_t more) const {
        if (points_.size() + more > points_.capacity())
            limits::need(2 * points_.capacity() * sizeof(LatticePoint));
    }

    void endRun() {
        addRun(static_cast<std::uint32_t>(points_.size() - 1));
        taken_ = {};
    }

    void addRun(std::uint32_t last) {
        if (last > runStart_)
            runs_.push_back({runStart_, last});
        runStart_ = last;
    }

    std::vector<LatticePoint>& points_;
    std::vector<Run>& runs_;
    const glm::dvec2 min_, max_;
    Point current_{};
    unsigned beyond_ = 0;  ///< the sides beyond which all lies from the last point emitted to the current one
    bool isHeld_ = false;  ///< whether these differ
    bool started_ = false;
    std::uint32_t contourStart_ = 0, runStart_ = 0;
    Directions taken_;  ///< by the run so far
};

/// Halving so often brings any curve below a lattice step.
constexpr int maxHalvings = 400;

/// Takes contours as they are.
class ContourKeeper {
public:
    explicit ContourKeeper(FlatContours& contours) : kept_(contours) {}

    void start(Point p) {
        kept_.starts.push_back(std::uint32_t(kept_.points.size()));
        line(p);
    }
    void line(Point to) { kept_.points.push_back(to); }
    void lines(std::span<const Point> to) { kept_.points.insert(kept_.points.end(), to.begin(), to.end()); }
    void linesInside(std::span<const Point> to) { lines(to); }
    bool keepsInside(const Cubic&) const { return true; }
    bool keepsBeyond(const Cubic&) const { return false; }

private:
    FlatContours& kept_;
};

template <class Sink>
class Flattener : public CurveSink {
public:
    Flattener(Sink& sink, ChordTolerance tolerance)
        : sink_(sink), tolerance_(tolerance.distance), cutter_(tolerance) {}
    void start(Point p) override { sink_.start(p); }
    void line(Point to) override { sink_.line(to); }
    void cubic(const Cubic& c) override { flatten(c, maxHalvings); }

private:
    void flatten(const Cubic& c, int halvings) {
        limits::check();
        if (halvings == 0 || geometry::chordError(c) <= tolerance_ || sink_.keepsBeyond(c))
            return sink_.line(c.p3);
        const bool isInside = sink_.keepsInside(c);
        const std::span<const Point> ends = cutter_.cut(c);
        // Where there would be too many, halves are cut, so that their bends are seen.
        if (ends.empty()) {
            for (const Cubic& half : geometry::halves(c))
                flatten(half, halvings - 1);
        } else {
            isInside ? sink_.linesInside(ends) : sink_.lines(ends);
        }
    }

    Sink& sink_;
    const double tolerance_;
    ChordCutter cutter_;
};

/// Contours of strokes on their way to the lattice.
class MappedContours : public ContourSink {
public:
    MappedContours(RunSink& sink, const Affine& map, ChordTolerance tolerance)
        : sink_(sink), flattener_(sink, tolerance), map_(map) {}

    void start(Point p) override { sink_.start(start_ = map(p)); }
    void lines(std::span<const Point> to) override {
        mapped_.resize(to.size());
        std::transform(to.begin(), to.end(), mapped_.begin(), [m = map_](Point p) { return mapped(m, p); });
        sink_.lines(mapped_);
    }
    void cubic(Point c1, Point c2, Point to) override {
        flattener_.cubic({sink_.current(), map(c1), map(c2), map(to)});
    }
    void close() override { sink_.line(start_); }
    void sidesEnd() override {
        sink_.finish();
        sideRuns_ = sink_.runCount();
    }
    /// Those of the rings' right sides.
    std::size_t sideRuns() const { return sideRuns_; }

private:
    static Point mapped(const Affine& m, Point p) { return m[0] * p.x + m[1] * p.y + m[2]; }
    Point map(Point p) const { return mapped(map_, p); }

    RunSink& sink_;
    Flattener<RunSink> flattener_;
    const Affine map_;
    Point start_{};
    std::vector<Point> mapped_;
    std::size_t sideRuns_ = 0;
};

/// Calls visit(start, ends of the chords).
template <class Visit>
void forEachContour(std::span<const Point> points, std::span<const std::uint32_t> starts,
                    const Visit& visit) {
    for (std::size_t i = 0; i < starts.size(); ++i) {
        const std::size_t first = starts[i], end = i + 1 < starts.size() ? starts[i + 1] : points.size();
        visit(points[first], points.subspan(first + 1, end - first - 1));
    }
}

}  // namespace

std::optional<std::uint32_t> addStroke(Outlines& outlines, const scene::Path& path,
                                       const scene::StrokeStyle& style, double strokeTolerance,
                                       ChordTolerance chordTolerance, const Affine& toSteps,
                                       ChordTolerance tolerance, glm::dvec2 clampMin, glm::dvec2 clampMax,
                                       const std::optional<PathBox>& near) {
    RunSink sink(outlines, clampMin, clampMax);
    // Near the box numbers are small, and so are their roundings.
    const Point origin = near ? (near->min + near->max) / 2.0 : Point{0, 0};
    const Affine fromOrigin =
        near ? scene::compose(toSteps, scene::translation(origin.x, origin.y)) : toSteps;
    MappedContours contours(sink, withoutFarAway(fromOrigin), tolerance);
    const std::size_t before = outlines.runs.size();
    const bool isRings =
        near ? strokeContoursNear({near->min - origin, near->max - origin}, stroke::moved(path, -origin),
                                  style, strokeTolerance, chordTolerance, contours)
             : strokeContours(path, style, strokeTolerance, chordTolerance, contours);
    sink.finish();
    if (!isRings)
        return std::nullopt;
    return static_cast<std::uint32_t>(contours.sideRuns() - before);
}

void addOutline(Outlines& outlines, const scene::Path& path, const Affine& toSteps, ChordTolerance tolerance,
                glm::dvec2 clampMin, glm::dvec2 clampMax) {
    RunSink sink(outlines, clampMin, clampMax);
    Flattener flattener(sink, tolerance);
    walkCurves(path, toSteps, flattener, ErrorBudget::arcSteps);
    sink.finish();
}

FlatContours flatten(const scene::Path& path, const Affine& toSteps, ChordTolerance tolerance) {
    FlatContours contours;
    ContourKeeper keeper(contours);
    Flattener flattener(keeper, tolerance);
    walkCurves(path, toSteps, flattener, ErrorBudget::arcSteps);
    if (!contours.points.empty())
        contours.min = contours.max = contours.points.front();
    for (const Point p : contours.points) {
        contours.min = glm::min(contours.min, p);
        contours.max = glm::max(contours.max, p);
    }
    return contours;
}

bool addContours(Outlines& outlines, const FlatContours& contours, Point by, glm::dvec2 clampMin,
                 glm::dvec2 clampMax) {
    const Point min = contours.min + by, max = contours.max + by;
    // Not if they are no numbers either.
    if (!(min.x >= clampMin.x && min.y >= clampMin.y && max.x <= clampMax.x && max.y <= clampMax.y))
        return false;
    RunSink sink(outlines, clampMin, clampMax);
    std::vector<Point> moved(contours.points.size());
    std::transform(contours.points.begin(), contours.points.end(), moved.begin(),
                   [by](Point p) { return p + by; });
    forEachContour(moved, contours.starts, [&](Point start, std::span<const Point> ends) {
        sink.start(start);
        if (!ends.empty())
            sink.linesInside(ends);
    });
    sink.finish();
    return true;
}

void addCutContours(Outlines& outlines, const FlatContours& contours, glm::dvec2 clampMin,
                    glm::dvec2 clampMax) {
    RunSink sink(outlines, clampMin, clampMax);
    forEachContour(contours.points, contours.starts, [&](Point start, std::span<const Point> ends) {
        sink.start(start);
        sink.lines(ends);
    });
    sink.finish();
}

double largestStretch(const Affine& m) {
    // Largest singular value of the linear part: sqrt of the larger eigenvalue of MᵀM.
    const double a = m[0].x * m[0].x + m[0].y * m[0].y, d = m[1].x * m[1].x + m[1].y * m[1].y;
    const double b = m[0].x * m[1].x + m[0].y * m[1].y;
    return std::sqrt((a + d) / 2 + std::hypot((a - d) / 2, b));
}

}  // namespace vtm::compiler
