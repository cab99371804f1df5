#include "text/color/gradients.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace vtm::text {
namespace {

scene::Color mixed(const scene::Color& a, const scene::Color& b, double share) {
    const auto channel = [share](float x, float y) { return float(x + (y - x) * share); };
    return {channel(a.r, b.r), channel(a.g, b.g), channel(a.b, b.b), channel(a.a, b.a)};
}

/// The line moved so that its stops fill [0, 1], and where that was.
struct Normal {
    std::vector<scene::GradientStop> stops;
    double first, last;
};

/// Nothing for a repeated line without extent. A padded one without extent keeps its step at 0.
std::optional<Normal> normalized(const ColorLine& line) {
    const double first = line.stops.front().offset, last = line.stops.back().offset;
    if (first == last && line.spread != scene::Spread::Pad)
        return std::nullopt;
    Normal normal{{}, first, first == last ? first + 1 : last};
    for (const ColorLine::Stop& stop : line.stops)
        normal.stops.push_back({float((stop.offset - first) / (normal.last - first)), stop.color});
    return normal;
}

Circle between(const Circle& a, const Circle& b, double share) {
    return {a.center + (b.center - a.center) * share, a.radius + (b.radius - a.radius) * share};
}

bool isInside(const Circle& inner, const Circle& outer) {
    return glm::distance(inner.center, outer.center) + inner.radius < outer.radius;
}

void reverse(std::vector<scene::GradientStop>& stops) {
    std::reverse(stops.begin(), stops.end());
    for (scene::GradientStop& stop : stops)
        stop.offset = 1 - stop.offset;
}

scene::Point direction(double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return {std::cos(angle), std::sin(angle)};
}

constexpr double fullTurn = 360, sectorAngle = 1;

/// Where the colour of a sweep may change its slope, and every degree.
std::vector<double> sweepCuts(const ColorLine& line, double start, double end) {
    std::vector<double> cuts;
    for (double angle = 0; angle <= fullTurn; angle += sectorAngle)
        cuts.push_back(angle);
    for (const ColorLine::Stop& stop : line.stops)
        if (const double angle = start + (end - start) * stop.offset; angle > 0 && angle < fullTurn)
            cuts.push_back(angle);
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
    return cuts;
}

/// No point of the extent is farther from `from`.
double reach(const Extent& extent, scene::Point from) {
    return glm::length(glm::max(glm::abs(extent.min - from), glm::abs(extent.max - from)));
}

scene::Path disc(const Circle& circle) {
    const scene::Point radii(circle.radius), right(circle.radius, 0);
    return {scene::MoveTo{circle.center + right}, scene::ArcTo{radii, 0, false, true, circle.center - right},
            scene::ArcTo{radii, 0, false, true, circle.center + right}, scene::Close{}};
}

/// The offsets at which a circle of the cone has a radius and may touch the extent.
std::pair<double, double> coneOffsets(const Circle& first, const Circle& second, const Extent& extent) {
    constexpr double farthest = 64;  // of nearly tangent circles, those beyond are far from every glyph
    const double growth = second.radius - first.radius;
    const double speed = glm::distance(first.center, second.center) - std::abs(growth);
    const double limit =
        speed > 0 ? std::min((reach(extent, first.center) + first.radius) / speed, farthest) : farthest;
    std::pair<double, double> offsets{-limit, limit};
    const double apex = -first.radius / growth;
    if (growth > 0)
        offsets.first = std::max(offsets.first, apex);
    else if (growth < 0)
        offsets.second = std::min(offsets.second, apex);
    return offsets;
}

}  // namespace

Extent boundsOf(const scene::Path& path, const scene::Affine& transform) {
    Extent extent{scene::Point(HUGE_VAL), scene::Point(-HUGE_VAL)};
    const auto add = [&](scene::Point p) {
        p = scene::apply(transform, p);
        extent = {glm::min(extent.min, p), glm::max(extent.max, p)};
    };
    for (const scene::Command& command : path) {
        if (const auto end = scene::endOf(command))
            add(*end);
        if (const auto* quad = std::get_if<scene::QuadTo>(&command))
            add(quad->control);
        if (const auto* cubic = std::get_if<scene::CubicTo>(&command)) {
            add(cubic->control1);
            add(cubic->control2);
        }
    }
    return extent;
}

scene::Color ColorLine::at(double offset) const {
    const double first = stops.front().offset, length = stops.back().offset - first;
    if (spread != scene::Spread::Pad && length > 0) {
        const double turns = (offset - first) / length, whole = std::floor(turns);
        const bool isMirrored = spread == scene::Spread::Reflect && std::fmod(std::abs(whole), 2) == 1;
        offset = first + length * (isMirrored ? 1 - (turns - whole) : turns - whole);
    }
    const auto next =
        std::find_if(stops.begin(), stops.end(), [&](const Stop& stop) { return stop.offset > offset; });
    if (next == stops.begin())
        return stops.front().color;
    if (next == stops.end())
        return stops.back().color;
    const Stop& before = next[-1];
    return mixed(before.color, next->color, (offset - before.offset) / (next->offset - before.offset));
}

std::optional<scene::Paint> linearGradient(const ColorLine& line, scene::Point p0, scene::Point p1,
                                           scene::Point p2) {
    const scene::Point along = p1 - p0, normal(p0.y - p2.y, p2.x - p0.x);
    const double share = glm::dot(along, normal), length = glm::dot(normal, normal);
    const auto stops = normalized(line);
    if (share == 0 || length == 0 || !stops)
        return std::nullopt;
    if (stops->stops.size() < 2)
        return line.stops.front().color;
    const scene::Point step = normal * (share / length);
    return scene::LinearGradient{p0 + step * stops->first, p0 + step * stops->last, stops->stops,
                                 line.spread};
}

std::optional<scene::Paint> radialGradient(const ColorLine& line, Circle first, Circle second) {
    auto stops = normalized(line);
    if (!stops)
        return std::nullopt;
    if (stops->stops.size() < 2)
        return line.stops.front().color;
    Circle inner = between(first, second, stops->first), outer = between(first, second, stops->last);
    if (inner.radius > outer.radius) {
        std::swap(inner, outer);
        reverse(stops->stops);
    }
    if (inner.radius < 0 || !isInside(inner, outer))
        return std::nullopt;
    return scene::RadialGradient{outer.center, outer.radius, inner.center,
                                 inner.radius, stops->stops, line.spread};
}

std::vector<ColoredPath> sweepGradient(const ColorLine& line, scene::Point center, double start, double end,
                                       const Extent& extent) {
    std::vector<ColoredPath> pieces;
    if (start == end && line.spread != scene::Spread::Pad)
        return pieces;
    const double radius = 2 * reach(extent, center);  // chords of a degree stay outside the extent
    const std::vector<double> cuts = sweepCuts(line, start, end);
    for (std::size_t i = 1; i < cuts.size(); ++i) {
        const double middle = (cuts[i - 1] + cuts[i]) / 2;
        const double offset =
            start == end ? (middle < start ? -HUGE_VAL : HUGE_VAL) : (middle - start) / (end - start);
        pieces.push_back({scene::polygon({center, center + radius * direction(cuts[i - 1]),
                                          center + radius * direction(cuts[i])}),
                          line.at(offset)});
    }
    return pieces;
}

std::vector<ColoredPath> coneGradient(const ColorLine& line, Circle first, Circle second,
                                      const Extent& extent) {
    constexpr int discs = 256;
    std::vector<ColoredPath> pieces;
    const auto [low, high] = coneOffsets(first, second, extent);
    for (int i = 0; i < discs; ++i) {
        const double offset = low + (high - low) * (i + 0.5) / discs;
        const Circle circle = between(first, second, offset);
        if (circle.radius > 0)
            pieces.push_back({disc(circle), line.at(offset)});
    }
    return pieces;
}

}  // namespace vtm::text
