#include "compiler/stroke/near.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace vtm::compiler::stroke {

namespace {

/// A curve is cut down to pieces of this share of the stroke's reach, or of the box, if that is more: then
/// what is kept is little longer than what reaches the box.
constexpr double pieceShare = 1.0 / 1024, boxShare = 1.0 / 4;
/// Beyond it a piece is kept, however long: halves of a finite curve are smaller by then than doubles can
/// tell.
constexpr int maxHalvings = 60;
/// For roundings.
constexpr double sureReach = 1 + 1e-6;

struct Interval {
    double from, to;
};

/// How far from a path its stroke reaches.
struct Reach {
    double sides, joins;

    Reach(const scene::StrokeStyle& style, double tolerance) {
        const double radius = style.width / 2;
        const double caps = style.cap == scene::Cap::Square ? std::numbers::sqrt2 : 1;
        const bool isMitred = style.join == scene::Join::Miter || style.join == scene::Join::MiterClip;
        sides = radius * caps * sureReach + 4 * tolerance;
        joins = isMitred ? std::max(sides, radius * (style.miterLimit + 1) * sureReach) : sides;
    }
};

class Finder {
public:
    Finder(const Reach& reach, const PathBox& box)
        : reach_(reach),
          box_(box),
          smallest_(std::max(pieceShare * reach.sides, boxShare * glm::distance(box.min, box.max))) {}

    /// The parameters of a segment's parts that are near.
    const std::vector<Interval>& parts(const Segment& segment) {
        parts_.clear();
        startsNear_ = distance(segment.curve.p0, segment.curve.p0) <= reach_.joins;
        endsNear_ = distance(segment.curve.p3, segment.curve.p3) <= reach_.joins;
        find(segment.curve, 0, 1, maxHalvings);
        return parts_;
    }
    bool isNear(Point p) const { return distance(p, p) <= reach_.joins; }

private:
    /// From a box to the box.
    double distance(Point min, Point max) const {
        return glm::length(glm::max(glm::max(box_.min - max, min - box_.max), Point{0, 0}));
    }

    void find(const Cubic& curve, double from, double to, int halvings) {
        const Cubic c = from == 0 && to == 1 ? curve : geometry::part(curve, from, to);
        const Point min = glm::min(glm::min(c.p0, c.p1), glm::min(c.p2, c.p3)),
                    max = glm::max(glm::max(c.p0, c.p1), glm::max(c.p2, c.p3));
        const bool hasJoin = (from == 0 && startsNear_) || (to == 1 && endsNear_);
        if (!hasJoin && distance(min, max) > reach_.sides)
            return;
        if (halvings == 0 || glm::distance(min, max) <= smallest_)
            return keep(from, to);
        const double middle = (from + to) / 2;
        find(curve, from, middle, halvings - 1);
        find(curve, middle, to, halvings - 1);
    }

    void keep(double from, double to) {
        if (!parts_.empty() && parts_.back().to == from)
            parts_.back().to = to;
        else
            parts_.push_back({from, to});
    }

    const Reach reach_;
    const PathBox box_;
    const double smallest_;
    bool startsNear_ = false, endsNear_ = false;
    std::vector<Interval> parts_;
};

/// Connected parts, in order.
class Chains {
public:
    void add(const Segment& segment, Interval interval) {
        if (!(isOpen_ && interval.from == 0))
            chains_.emplace_back();
        const bool isWhole = interval.from == 0 && interval.to == 1;
        chains_.back().segments.push_back(
            {isWhole ? segment.curve : geometry::part(segment.curve, interval.from, interval.to),
             segment.straight, segment.circle, segment.afterCusp && interval.from == 0});
        isOpen_ = interval.to == 1;
    }
    void gap() { isOpen_ = false; }
    /// The last one goes on with the first one, over the subpath's start.
    void join() {
        if (!isOpen_ || chains_.size() < 2)
            return;
        auto& first = chains_.front().segments;
        auto& last = chains_.back().segments;
        first.insert(first.begin(), last.begin(), last.end());
        chains_.pop_back();
    }
    std::vector<Subpath>& all() { return chains_; }

private:
    std::vector<Subpath> chains_;
    bool isOpen_ = false;
};

}  // namespace

scene::Path moved(const scene::Path& path, Point by) {
    scene::Path result = path;
    for (scene::Command& command : result)
        std::visit(
            [&](auto& c) {
                if constexpr (requires { c.to; })
                    c.to += by;
                if constexpr (requires { c.control; })
                    c.control += by;
                if constexpr (requires { c.control1; })
                    c.control1 += by, c.control2 += by;
            },
            command);
    return result;
}

bool nearParts(const Subpath& subpath, const scene::StrokeStyle& style, const PathBox& box, double tolerance,
               std::vector<Subpath>& near) {
    Finder finder(Reach(style, tolerance), box);
    const auto& segments = subpath.segments;
    if (segments.empty()) {
        if (finder.isNear(subpath.at))
            near.push_back(subpath);
        return true;
    }
    Chains chains;
    bool isAll = true, startsNear = false;
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const std::vector<Interval>& parts = finder.parts(segments[i]);
        if (i == 0)
            startsNear = !parts.empty() && parts.front().from == 0;
        isAll &= parts.size() == 1 && parts[0].from == 0 && parts[0].to == 1;
        for (const Interval& interval : parts)
            chains.add(segments[i], interval);
        if (parts.empty())
            chains.gap();
    }
    if (isAll) {
        near.push_back(subpath);
        return true;
    }
    if (subpath.closed && startsNear)
        chains.join();
    std::move(chains.all().begin(), chains.all().end(), std::back_inserter(near));
    return false;
}

}  // namespace vtm::compiler::stroke
