#include "paper/compile/outline.hpp"

#include <algorithm>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "compiler/lower/chords.hpp"

namespace vtm::paper {

namespace {

/// Halvings of a cubic at most: 65536 chords.
constexpr int maxHalvings = 16;

/// The mask's square and what its cells see beyond it.
constexpr double seenMin = -0.25, seenMax = 1.25;

bool isFar(const compiler::Cubic& c) {
    const geometry::Box box = geometry::controlBox(c);
    return box.max.x < seenMin || box.max.y < seenMin || box.min.x > seenMax || box.min.y > seenMax;
}

class ChordSink : public compiler::CurveSink {
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
    void cubic(const compiler::Cubic& c) override { flatten(c, 0); }

    std::vector<Chord> chords;

private:
    void flatten(const compiler::Cubic& c, int halvings) {
        if (halvings == maxHalvings || geometry::chordError(c) <= tolerance_ || isFar(c))
            return line(c.p3);
        for (const compiler::Cubic& half : geometry::halves(c))
            flatten(half, halvings + 1);
    }

    const double tolerance_;
    Point current_{};
    std::uint32_t contour_ = 0;
};

/// Bounds of the control points.
class BoundsSink : public compiler::CurveSink {
public:
    void start(Point p) override { box.add(p); }
    void line(Point to) override { box.add(to); }
    void cubic(const compiler::Cubic& c) override { box.add(geometry::controlBox(c)); }

    geometry::Box box;
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
    compiler::walkCurves(path, toPicture, bounds);
    const geometry::Box seen = bounds.box.intersection({Point(0), size});
    if (seen.empty())
        return {};
    const double side = grow * std::max(seen.width(), seen.height());
    return {(seen.min + seen.max) * 0.5 - side / 2, side};
}

Outline outlineInMask(const scene::Path& path, const scene::Affine& toPicture, scene::FillRule rule,
                      const Placement& placement, double tolerance) {
    const double scale = 1 / placement.side;
    const scene::Affine toMask =
        scene::compose({scale, 0, 0, scale, -placement.min.x * scale, -placement.min.y * scale}, toPicture);
    ChordSink sink(tolerance);
    compiler::walkCurves(path, toMask, sink);
    return {std::move(sink.chords), rule};
}

}  // namespace vtm::paper
