#include "svg/geometry/stroke_box.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include "svg/geometry/path_geometry.hpp"

namespace vtm::svg {
namespace {

using scene::Point;

Point across(Point direction) { return {-direction.y, direction.x}; }

/// A segment by its ends and unit directions there.
struct Leg {
    Point from, to, leaving, arriving;
};

/// Takes segments in turn; those without length are passed over.
class StrokeBoxBuilder {
public:
    explicit StrokeBoxBuilder(const scene::StrokeStyle& stroke) : stroke_(stroke), half_(stroke.width / 2) {}

    void operator()(const MoveSegment& move) {
        endSubpath(false);
        start_ = move.to;
        isOpen_ = true;
    }
    void operator()(const LineSegment& line) {
        isDrawn_ = true;
        add(line.from, line.to, line.to - line.from, line.to - line.from);
        if (line.closes) {
            endSubpath(true);
            start_ = line.to;
        }
    }
    void operator()(const geometry::Cubic& c) {
        isDrawn_ = true;
        const auto first = [](std::initializer_list<Point> directions) {
            const auto found = std::ranges::find_if(directions, [](Point d) { return d != Point(0); });
            return found == directions.end() ? Point(0) : *found;
        };
        add(c.p0, c.p3, first({c.p1 - c.p0, c.p2 - c.p0, c.p3 - c.p0}),
            first({c.p3 - c.p2, c.p3 - c.p1, c.p3 - c.p0}));
        addExtremes(geometry::bounds(c), c.p0, c.p3);
    }
    void operator()(const ArcSegment& a) {
        isDrawn_ = true;
        const double sign = a.arc.sweep < 0 ? -1 : 1;
        add(a.from, a.to, sign * a.arc.derivative(a.arc.start),
            sign * a.arc.derivative(a.arc.start + a.arc.sweep));
        addExtremes(geometry::bounds(a.arc), a.from, a.to);
    }

    Box finish() {
        endSubpath(false);
        return box_;
    }

private:
    void add(Point from, Point to, Point leaving, Point arriving) {
        if (leaving != Point(0) && arriving != Point(0))
            legs_.push_back({from, to, glm::normalize(leaving), glm::normalize(arriving)});
    }

    /// Where a curve turns back between its ends the stroke's edge is parallel to it.
    void addExtremes(const Box& whole, Point from, Point to) {
        // A share of the curve's size: ends that are extremes are not met exactly.
        const double noise = 1e-12 * (whole.width() + whole.height());
        for (int axis = 0; axis < 2; ++axis) {
            if (whole.min[axis] < std::min(from[axis], to[axis]) - noise)
                grow(axis, whole.min[axis]);
            if (whole.max[axis] > std::max(from[axis], to[axis]) + noise)
                grow(axis, whole.max[axis]);
        }
    }
    void grow(int axis, double at) {
        box_.min[axis] = std::min(box_.min[axis], at - half_);
        box_.max[axis] = std::max(box_.max[axis], at + half_);
    }

    void addSides(Point at, Point direction) {
        box_.add(at + half_ * across(direction));
        box_.add(at - half_ * across(direction));
    }
    void addDisc(Point at) { box_.add(Box{at - Point(half_), at + Point(half_)}); }

    /// `outwards`: the direction in which the path would go on.
    void addCap(Point at, Point outwards) {
        if (stroke_.cap == scene::Cap::Round)
            addDisc(at);
        else if (stroke_.cap == scene::Cap::Square)
            addSides(at + half_ * outwards, outwards);
    }

    void addJoin(Point at, Point arriving, Point leaving) {
        if (stroke_.join == scene::Join::Round)
            return addDisc(at);
        if (stroke_.join == scene::Join::Bevel || arriving == leaving)
            return;
        // The mitre's length is the stroke's width over the sine of half the angle between the legs.
        const double sine = std::sqrt(std::max(0.0, (1 + glm::dot(arriving, leaving)) / 2));
        const bool isWithin = sine * stroke_.miterLimit >= 1;
        if (!isWithin && stroke_.join == scene::Join::Miter)
            return;
        box_.add(at +
                 half_ * (isWithin ? 1 / sine : stroke_.miterLimit) * glm::normalize(arriving - leaving));
    }

    void endSubpath(bool closes) {
        for (std::size_t i = 0; i < legs_.size(); ++i) {
            const Leg& leg = legs_[i];
            addSides(leg.from, leg.leaving);
            addSides(leg.to, leg.arriving);
            if (i > 0)
                addJoin(leg.from, legs_[i - 1].arriving, leg.leaving);
        }
        if (legs_.empty() && isOpen_ && isDrawn_ && stroke_.cap != scene::Cap::Butt) {
            addDisc(start_);  // a square of the same size, if not a disc
        } else if (!legs_.empty() && closes) {
            addJoin(legs_[0].from, legs_.back().arriving, legs_[0].leaving);
        } else if (!legs_.empty()) {
            addCap(legs_[0].from, -legs_[0].leaving);
            addCap(legs_.back().to, legs_.back().arriving);
        }
        legs_.clear();
        isDrawn_ = false;
    }

    const scene::StrokeStyle& stroke_;
    double half_;
    Box box_;
    std::vector<Leg> legs_;
    Point start_{};
    bool isOpen_ = false, isDrawn_ = false;
};

}  // namespace

Box strokeBox(const scene::Path& path, const scene::StrokeStyle& stroke) {
    StrokeBoxBuilder builder(stroke);
    forEachSegment(path, builder);
    return builder.finish();
}

}  // namespace vtm::svg
