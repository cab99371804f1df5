#include "compiler/paper/outline.hpp"

#include <algorithm>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "compiler/lower/cubics.hpp"

namespace vtm::compiler::paper {

namespace {

/// Halvings of a cubic at most: 65536 chords.
constexpr int maxHalvings = 16;

/// The mask's square and what its cells see beyond it.
constexpr double seenMin = -0.25, seenMax = 1.25;

bool isFar(const Cubic& c) {
    Point min = c[0], max = c[0];
    for (const Point p : c)
        min = glm::min(min, p), max = glm::max(max, p);
    return max.x < seenMin || max.y < seenMin || min.x > seenMax || min.y > seenMax;
}

/// |B''| <= 6 max of the second differences, and a chord is within |B''| / 8 of its curve.
bool isFlat(const Cubic& c, double tolerance) {
    const double bend =
        std::max(glm::length(c[0] - 2.0 * c[1] + c[2]), glm::length(c[1] - 2.0 * c[2] + c[3]));
    return 0.75 * bend <= tolerance;
}

class ChordSink : public CurveSink {
public:
    explicit ChordSink(double tolerance) : tolerance_(tolerance) {}

    void start(Point p) override {
        current_ = p;
        ++contour_;
    }
    void line(Point to) override {
        if (to != current_)
            chords.push_back({current_, to, contour_});
        current_ = to;
    }
    void cubic(const Cubic& c) override { flatten(c, 0); }

    std::vector<Chord> chords;

private:
    void flatten(const Cubic& c, int halvings) {
        if (halvings == maxHalvings || isFlat(c, tolerance_) || isFar(c))
            return line(c[3]);
        const Point ab = (c[0] + c[1]) * 0.5, bc = (c[1] + c[2]) * 0.5, cd = (c[2] + c[3]) * 0.5;
        const Point abc = (ab + bc) * 0.5, bcd = (bc + cd) * 0.5, middle = (abc + bcd) * 0.5;
        flatten({c[0], ab, abc, middle}, halvings + 1);
        flatten({middle, bcd, cd, c[3]}, halvings + 1);
    }

    const double tolerance_;
    Point current_{};
    std::uint32_t contour_ = 0;
};

/// Bounds of the control points.
class BoundsSink : public CurveSink {
public:
    void start(Point p) override { add(p); }
    void line(Point to) override { add(to); }
    void cubic(const Cubic& c) override {
        for (const Point p : c)
            add(p);
    }

    Point min{std::numeric_limits<double>::infinity()}, max{-std::numeric_limits<double>::infinity()};

private:
    void add(Point p) { min = glm::min(min, p), max = glm::max(max, p); }
};

}  // namespace

double orient(Point a, Point b, Point p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); }

int windingChange(const Outline& outline, const std::vector<std::uint32_t>& chords, Point from, Point to) {
    int change = 0;
    for (const std::uint32_t i : chords) {
        const Chord& c = outline.chords[i];
        if ((orient(from, to, c.a) > 0) == (orient(from, to, c.b) > 0))
            continue;
        const bool wasLeft = orient(c.a, c.b, from) > 0, isLeft = orient(c.a, c.b, to) > 0;
        change += int(isLeft) - int(wasLeft);
    }
    return change;
}

int windingAt(const Outline& outline, Point p) {
    int winding = 0;
    for (const Chord& c : outline.chords) {
        const bool down = c.a.y > p.y, up = c.b.y > p.y;
        if (down != up && (orient(c.a, c.b, p) > 0) == up)  // the chord passes to the right of p
            winding += up ? 1 : -1;
    }
    return winding;
}

Placement placeMask(const scene::Path& path, const scene::Affine& toPicture, Point size) {
    constexpr double grow = 8.0 / 7;  // 1/16 of the result stays free on either side
    BoundsSink bounds;
    walkCurves(path, toPicture, bounds);
    const Point min = glm::max(bounds.min, Point(0)), max = glm::min(bounds.max, size);
    if (!(min.x <= max.x && min.y <= max.y))
        return {};
    const double side = grow * std::max(max.x - min.x, max.y - min.y);
    return {(min + max) * 0.5 - side / 2, side};
}

Outline outlineInMask(const scene::Path& path, const scene::Affine& toPicture, scene::FillRule rule,
                      const Placement& placement, double tolerance) {
    const double scale = 1 / placement.side;
    const scene::Affine toMask =
        scene::compose({scale, 0, 0, scale, -placement.min.x * scale, -placement.min.y * scale}, toPicture);
    ChordSink sink(tolerance);
    walkCurves(path, toMask, sink);
    return {std::move(sink.chords), rule};
}

}  // namespace vtm::compiler::paper
