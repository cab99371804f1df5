#include "api/openvg/src/path_masks.hpp"

#include <algorithm>
#include <cmath>

#include "api/openvg/src/flatten.hpp"
#include "api/openvg/src/path_measure.hpp"
#include "compiler/stroke.hpp"

namespace vtm::openvg {

namespace {

/// Styles of one path whose masks are kept.
constexpr std::size_t mostStrokes = 4;

/// Of the size of the outline: half of what its mask is compiled with at best.
constexpr double strokeTolerance = 1.0 / (1 << 22);

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
        if (strokes_.size() == mostStrokes)
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
    const std::vector<Segment> segments = path.segments();
    const scene::Path line = outline(segments);
    const Box box = boxOf(line);
    const double size = std::max(box.max.x - box.min.x, box.max.y - box.min.y) + parameters.style.width;
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
