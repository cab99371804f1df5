#include "api/openvg/draw/path_masks.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <stdexcept>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <vtm/compiler/stroke.hpp>
#include "api/openvg/path/flatten.hpp"
#include "api/openvg/path/path_measure.hpp"
#include "api/openvg/path/segment.hpp"

namespace vtm::openvg {

namespace {

/// Styles of one path whose masks are kept.
constexpr std::size_t maxStrokes = 4;

/// Of the size of the outline: a 64th of a pixel at 65536 pixels. Strokes beyond that are as exact as this,
/// whatever their mask is.
constexpr double strokeTolerance = 1.0 / (1 << 22);

/// A path that reaches farther than this many widths is stroked as lines: the stroker would fit curves to a
/// share of the width, near to what doubles hold.
constexpr double maxWidths = 1 << 26;
/// Lines for a curve then. They are off by 6 / (8 · 1024²) of its controls' polygon at most, 2^-20.
constexpr int linesPerCurve = 1024;

/// Points nearer to each other than this share of the stroked path's reach are one: directions between them
/// no double can square.
constexpr double nearestPoints = 1.0 / (1LL << 48);

/// About a second and 200 megabytes, where all of them are seen.
constexpr double maxDashes = 100'000;

/// Throws std::length_error.
void requireFewDashes(std::span<const Segment> segments, const std::vector<double>& dashes) {
    if (dashes.empty())
        return;
    const double period = std::accumulate(dashes.begin(), dashes.end(), 0.0);
    if (!(length(segments) / period * double(dashes.size() / 2) <= maxDashes))
        throw std::length_error("too many dashes");
}

double reachOf(const geometry::Box& box) {
    const glm::dvec2 far = glm::max(glm::abs(box.min), glm::abs(box.max));
    return std::max(far.x, far.y);
}

/// Curves that are a point, but for `minimum`, become lines, and controls lie on ends that near.
void snapCurves(std::vector<Segment>& segments, double minimum) {
    const auto isNear = [&](Point a, Point b) { return glm::distance(a, b) < minimum; };
    for (Segment& s : segments) {
        if (const auto arc = arcOf(s)) {
            if (glm::length(arc->axisX) < minimum && glm::length(arc->axisY) < minimum)
                s.type = VG_LINE_TO;
            continue;
        }
        if (s.type != VG_QUAD_TO && s.type != VG_CUBIC_TO)
            continue;
        Point& last = s.type == VG_QUAD_TO ? s.control1 : s.control2;
        if (isNear(s.control1, s.from) && isNear(last, s.from) && isNear(s.to, s.from))
            s.type = VG_LINE_TO;
        if (isNear(s.control1, s.from))
            s.control1 = s.from;
        if (isNear(last, s.to))
            last = s.to;
    }
}

std::vector<Segment> asLines(const std::vector<Segment>& segments) {
    std::vector<Segment> lines;
    for (const Segment& s : segments) {
        if (s.type == VG_CLOSE_PATH || s.type == VG_MOVE_TO || s.type == VG_LINE_TO) {
            lines.push_back(s);
            continue;
        }
        const auto arc = arcOf(s);
        const auto at = [&](double t) {
            const Point a = glm::mix(s.from, s.control1, t), b = glm::mix(s.control1, s.control2, t),
                        c = glm::mix(s.control2, s.to, t);
            if (s.type == VG_CUBIC_TO)
                return glm::mix(glm::mix(a, b, t), glm::mix(b, c, t), t);
            if (s.type == VG_QUAD_TO)
                return glm::mix(a, glm::mix(s.control1, s.to, t), t);
            return arc->at(arc->start + t * arc->sweep);
        };
        Segment line;
        line.type = VG_LINE_TO;
        line.from = s.from;
        const int count = s.isArc() && !arc ? 1 : linesPerCurve;
        for (int i = 1; i <= count; ++i) {
            line.to = i == count ? s.to : at(double(i) / count);
            lines.push_back(line);
            line.from = line.to;
        }
    }
    return lines;
}

/// What the stroker takes, of a path with this box.
std::vector<Segment> strokable(std::vector<Segment> segments, const geometry::Box& box, double width) {
    const double reach = reachOf(box);
    snapCurves(segments, nearestPoints * std::max(reach, width));
    return reach > maxWidths * width ? asLines(segments) : segments;
}

}  // namespace

PathMask& PathMasks::filled(const PathData& path, scene::FillRule rule) {
    std::unique_ptr<PathMask>& mask = rule == scene::FillRule::NonZero ? nonZero_ : evenOdd_;
    if (!mask)
        mask = std::make_unique<PathMask>(outline(path.segments()), rule);
    return *mask;
}

PathMask& PathMasks::stroked(const PathData& path, const StrokeParameters& parameters) {
    auto it = std::ranges::find(strokes_, parameters, &Stroke::parameters);
    if (it == strokes_.end()) {
        auto mask = std::make_unique<PathMask>(strokeOutline(path, parameters), scene::FillRule::NonZero);
        if (strokes_.size() == maxStrokes)
            strokes_.pop_back();
        strokes_.push_front({parameters, std::move(mask)});
        it = strokes_.begin();
    }
    std::rotate(strokes_.begin(), it, it + 1);
    return *strokes_.front().mask;
}

void PathMasks::clear() {
    nonZero_.reset();
    evenOdd_.reset();
    strokes_.clear();
}

scene::Path strokeOutline(const PathData& path, const StrokeParameters& parameters) {
    const std::vector<Segment> plain = withoutRationals(path.segments());
    const geometry::Box box = boxOf(outline(plain));
    const std::vector<Segment> segments = strokable(plain, box, parameters.style.width);
    requireFewDashes(segments, parameters.style.dashes);
    const scene::Path line = outline(segments);
    const double size = std::max(box.width(), box.height()) + parameters.style.width;
    const double tolerance = size * strokeTolerance;
    if (parameters.style.dashes.empty() || parameters.dashPhaseReset)
        return compiler::strokeOutline(line, parameters.style, tolerance);
    // The pattern goes on from subpath to subpath.
    scene::Path result;
    StrokeParameters own = parameters;
    for (std::size_t first = 0; first < segments.size();) {
        std::size_t end = first + 1;
        while (end < segments.size() && segments[end].type != VG_MOVE_TO &&
               segments[end - 1].type != VG_CLOSE_PATH)
            ++end;
        const std::vector<Segment> subpath(segments.begin() + std::ptrdiff_t(first),
                                           segments.begin() + std::ptrdiff_t(end));
        scene::Path part = outline(subpath);
        if (subpath.front().type != VG_MOVE_TO)
            part.front() = scene::MoveTo{subpath.front().from};
        const scene::Path stroke = compiler::strokeOutline(part, own.style, tolerance);
        result.insert(result.end(), stroke.begin(), stroke.end());
        own.style.dashPhase += length(subpath);
        first = end;
    }
    return result;
}

}  // namespace vtm::openvg
