#include "svg/geometry/path_measure.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

#include "geometry/length.hpp"

namespace vtm::svg {
namespace {

/// Of lengths.
constexpr double relativeLengthError = 1e-9;
/// Bisections of a parameter in [0, 1]: 2^-40 of a segment.
constexpr int parameterBits = 40;

scene::Point pointAt(const LineSegment& line, double t) { return glm::mix(line.from, line.to, t); }
scene::Point pointAt(const geometry::Cubic& cubic, double t) { return cubic.at(t); }
scene::Point pointAt(const ArcSegment& arc, double t) {
    return arc.arc.at(arc.arc.start + t * arc.arc.sweep);
}

glm::dvec2 derivativeAt(const LineSegment& line, double) { return line.to - line.from; }
glm::dvec2 derivativeAt(const geometry::Cubic& cubic, double t) { return cubic.derivative(t); }
glm::dvec2 derivativeAt(const ArcSegment& arc, double t) {
    return arc.arc.derivative(arc.arc.start + t * arc.arc.sweep) * arc.arc.sweep;
}

template <class Segment>
double lengthTo(const Segment& segment, double end) {
    return geometry::relativeArcLength([&](double t) { return glm::length(derivativeAt(segment, t)); }, 0,
                                       end, relativeLengthError);
}

double lengthTo(const LineSegment& line, double end) { return end * glm::distance(line.from, line.to); }

/// The parameter at which the segment has run `length` of its `whole`.
template <class Segment>
double parameterAt(const Segment& segment, double length, double whole) {
    if constexpr (std::is_same_v<Segment, LineSegment>)
        return length / whole;
    double low = 0, high = 1, done = 0;  // `done`: the length up to `low`
    const auto speed = [&](double t) { return glm::length(derivativeAt(segment, t)); };
    for (int bit = 0; bit < parameterBits; ++bit) {
        const double middle = (low + high) / 2;
        const double more = geometry::relativeArcLength(speed, low, middle, relativeLengthError);
        if (done + more <= length) {
            low = middle;
            done += more;
        } else {
            high = middle;
        }
    }
    return low;
}

/// Where a curve stands still, as at coinciding control points, its direction is that of the chord nearby.
template <class Segment>
glm::dvec2 directionAt(const Segment& segment, double t) {
    constexpr double nearby = 1e-6;
    const glm::dvec2 derivative = derivativeAt(segment, t);
    if (glm::length(derivative) > 0)
        return glm::normalize(derivative);
    const double from = std::clamp(t - nearby, 0.0, 1.0), to = std::clamp(t + nearby, 0.0, 1.0);
    const glm::dvec2 chord = pointAt(segment, to) - pointAt(segment, from);
    return glm::length(chord) > 0 ? glm::normalize(chord) : glm::dvec2(1, 0);
}

}  // namespace

PathMeasure::PathMeasure(const scene::Path& path) {
    scene::Point start{}, end{};
    const auto add = [&](const auto& segment) {
        const double length = lengthTo(segment, 1);
        if (length > 0)
            segments_.push_back({segment, length_, length});
        length_ += length > 0 ? length : 0;
        end = pointAt(segment, 1);
    };
    bool first = true;
    forEachSegment(path, [&](const auto& segment) {
        if constexpr (std::is_same_v<std::decay_t<decltype(segment)>, MoveSegment>) {
            if (first)
                start = end = segment.to;
            first = false;
        } else {
            add(segment);
        }
    });
    closed_ = length_ > 0 && start == end;
}

PathMeasure::Place PathMeasure::at(double distance) const {
    const auto after =
        std::upper_bound(segments_.begin() + 1, segments_.end(), distance,
                         [](double d, const MeasuredSegment& measured) { return d < measured.start; });
    const MeasuredSegment& measured = *(after - 1);
    const double along = std::clamp(distance - measured.start, 0.0, measured.length);
    return std::visit(
        [&](const auto& segment) {
            const double t = parameterAt(segment, along, measured.length);
            const glm::dvec2 direction = directionAt(segment, t);
            return Place{pointAt(segment, t) + direction * (distance - measured.start - along), direction};
        },
        measured.segment);
}

}  // namespace vtm::svg
