#include "compiler/src/outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "compiler/src/chords.hpp"
#include "compiler/src/cubics.hpp"
#include "compiler/src/error_budget.hpp"

namespace vtm::compiler {
namespace {

using scene::Affine;
using scene::Point;

Point lerp(Point a, Point b, double t) { return a + (b - a) * t; }

/// Takes points in steps, cuts the polyline at the box, appends runs of chords between even vertices.
class RunSink {
public:
    RunSink(Outlines& outlines, glm::dvec2 min, glm::dvec2 max)
        : points_(outlines.points), runs_(outlines.runs), min_(min), max_(max) {}

    void start(Point p) {
        finish();
        current_ = p;
        inside_ = isInside(p);
        points_.push_back(quantise(p));
        contourStart_ = runStart_ = static_cast<std::uint32_t>(points_.size() - 1);
        started_ = true;
    }

    void line(Point to) {
        const bool inside = isInside(to);
        if (!(inside && inside_))
            for (double t : boxCuts(current_, to))
                if (t > 0 && t < 1)
                    emit(quantise(lerp(current_, to, t)));
        emit(inside ? nearestEven(to) : quantise(to));
        current_ = to;
        inside_ = inside;
    }

    /// Where the line so far and its next points are known to be inside the box.
    void linesInside(std::span<const Point> to) {
        for (const Point p : to)
            emit(nearestEven(p));
        current_ = to.back();
    }
    /// Whether the line so far ends inside the box and all of the curve lies there.
    bool keepsInside(const Cubic& c) const {
        return inside_ && isInside(c[1]) && isInside(c[2]) && isInside(c[3]);
    }

    /// Ends the last contour.
    void finish() {
        if (!started_)
            return;
        endRun();
        if (points_.size() - 1 == contourStart_)
            points_.pop_back();  // a point that nothing follows
        started_ = false;
    }

    Point min() const { return min_; }
    Point max() const { return max_; }

private:
    bool isInside(Point p) const { return p.x >= min_.x && p.x <= max_.x && p.y >= min_.y && p.y <= max_.y; }

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

    /// Of a point in the box, which keeps it within Coord. Truncation and a correction: floor without a call.
    static LatticePoint nearestEven(Point p) {
        const auto even = [](double v) {
            const double nearest = v / 2 + 0.5;
            const auto whole = static_cast<Coord>(nearest);
            return 2 * (whole - static_cast<Coord>(nearest < whole));
        };
        return {even(p.x), even(p.y)};
    }

    void emit(LatticePoint to) {
        const LatticePoint from = points_.back();
        if (to == from)
            return;
        // Seen without branches, whose outcome is random: the directions taken, one bit each.
        const unsigned steps = unsigned(to.x < from.x) | unsigned(to.x > from.x) << 1 |
                               unsigned(to.y < from.y) << 2 | unsigned(to.y > from.y) << 3;
        unsigned taken = taken_ | steps;
        if ((taken & (taken >> 1) & 0b0101u) != 0) {
            endRun();
            taken = steps;
        }
        taken_ = taken;
        points_.push_back(to);
    }

    void endRun() {
        const auto last = static_cast<std::uint32_t>(points_.size() - 1);
        if (last > runStart_)
            runs_.push_back({runStart_, last});
        runStart_ = last;
        taken_ = 0;
    }

    std::vector<LatticePoint>& points_;
    std::vector<Run>& runs_;
    const glm::dvec2 min_, max_;
    Point current_{};
    bool inside_ = false, started_ = false;
    std::uint32_t contourStart_ = 0, runStart_ = 0;
    unsigned taken_ = 0;  ///< directions of the run so far, one bit each: -x, +x, -y, +y
};

bool beyondOneSide(const Cubic& c, Point min, Point max) {
    for (int axis = 0; axis < 2; ++axis) {
        const auto [lo, hi] = std::minmax({c[0][axis], c[1][axis], c[2][axis], c[3][axis]});
        if (hi < min[axis] || lo > max[axis])
            return true;
    }
    return false;
}

std::array<Cubic, 2> halve(const Cubic& c) {
    const Point a = lerp(c[0], c[1], 0.5), b = lerp(c[1], c[2], 0.5), d = lerp(c[2], c[3], 0.5);
    const Point ab = lerp(a, b, 0.5), bd = lerp(b, d, 0.5), m = lerp(ab, bd, 0.5);
    return {Cubic{c[0], a, ab, m}, Cubic{m, bd, d, c[3]}};
}

/// Whether the cubic is so flat that one chord will do: it strays by at most max|P''| / 8, and |P''| <= 6
/// max|second difference of the controls| (Wang, Shen 1988). False for infinite curves.
bool isFlat(const Cubic& c, double tolerance) {
    const Point d0 = c[0] - c[1] * 2.0 + c[2], d1 = c[1] - c[2] * 2.0 + c[3];
    return 0.75 * 0.75 * std::max(d0.x * d0.x + d0.y * d0.y, d1.x * d1.x + d1.y * d1.y) <=
           tolerance * tolerance;
}

/// Cubics that need more chords are halved first, so that their bends are seen.
constexpr double chordsAtOnce = 256;
/// Those that may leave the box sooner, so that parts outside it can be left out.
constexpr double chordsAtBox = 8;
/// Halving so often brings any curve below a lattice step.
constexpr int maxHalvings = 400;

class Flattener : public CurveSink {
public:
    Flattener(RunSink& sink, double tolerance) : sink_(sink), tolerance_(tolerance), cutter_(tolerance) {}
    void start(Point p) override { sink_.start(p); }
    void line(Point to) override { sink_.line(to); }
    void cubic(const Cubic& c) override { flatten(c, maxHalvings); }

private:
    void flatten(const Cubic& c, int halvings) {
        const bool isInside = sink_.keepsInside(c);
        if (halvings == 0 || isFlat(c, tolerance_) ||
            (!isInside && beyondOneSide(c, sink_.min(), sink_.max())))
            return sink_.line(c[3]);
        const std::span<const Point> ends = cutter_.cut(c, isInside ? chordsAtOnce : chordsAtBox);
        if (ends.empty()) {
            for (const Cubic& half : halve(c))
                flatten(half, halvings - 1);
        } else if (isInside) {
            sink_.linesInside(ends);
        } else {
            for (const Point p : ends)
                sink_.line(p);
        }
    }

    RunSink& sink_;
    const double tolerance_;
    ChordCutter cutter_;
};

}  // namespace

void addOutline(Outlines& outlines, const scene::Path& path, const Affine& toSteps, double tolerance,
                glm::dvec2 clampMin, glm::dvec2 clampMax) {
    RunSink sink(outlines, clampMin, clampMax);
    Flattener flattener(sink, tolerance);
    walkCurves(path, toSteps, flattener, ErrorBudget::arcSteps);
    sink.finish();
}

double largestStretch(const Affine& m) {
    // Largest singular value of the linear part: sqrt of the larger eigenvalue of MᵀM.
    const double a = m[0].x * m[0].x + m[0].y * m[0].y, d = m[1].x * m[1].x + m[1].y * m[1].y;
    const double b = m[0].x * m[1].x + m[0].y * m[1].y;
    return std::sqrt((a + d) / 2 + std::hypot((a - d) / 2, b));
}

}  // namespace vtm::compiler
