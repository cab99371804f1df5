#include "compiler/stroke/thin_chords.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace vtm::compiler::stroke {
namespace {

constexpr int maxHalvings = 40;

/// Where a curve turns by θ in a chord, the offsets of its chords are moved by up to θ² r / 12 to the outer
/// side of the bend: by no more than the area in a pixel, which is about 20 times as wide as the area's root.
/// And they are shorter by θ² / 24, of a hairline's coverage too.
double turnOf(double radius, double area) {
    constexpr double most = 0.4;
    return std::min(most, std::sqrt(std::sqrt(area) / (2 * radius)));
}

}  // namespace

ThinChords::ThinChords(double radius, const ChordTolerance& tolerance)
    : distance_(tolerance.distance),
      shortest_(std::sqrt(tolerance.area) / 2),
      isThin_(tolerance.area > 0 && radius * radius <= mostThin * mostThin * tolerance.area),
      turn_(isThin_ ? turnOf(radius, tolerance.area) : 1),
      cutter_({tolerance.distance, tolerance.area, turn_}) {}

std::span<const Point> ThinChords::of(const Cubic& curve) {
    points_.assign({curve.p0});
    cut(curve, maxHalvings);
    if (points_.size() > 1 && isShort(curve.p3))
        points_.pop_back();
    points_.push_back(curve.p3);
    return points_;
}

void ThinChords::cut(const Cubic& curve, int halvings) {
    if (halvings == 0 || geometry::chordError(curve) <= distance_)
        return add(curve.p3);
    const std::span<const Point> ends = cutter_.cut(curve);
    for (const Point end : ends)
        add(end);
    if (ends.empty())
        for (const Cubic& half : geometry::halves(curve))
            cut(half, halvings - 1);
}

void ThinChords::add(Point to) {
    if (!isShort(to))
        points_.push_back(to);
}

bool ThinChords::isShort(Point to) const { return glm::distance(points_.back(), to) <= shortest_; }

}  // namespace vtm::compiler::stroke
