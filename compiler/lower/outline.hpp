/// \file
/// Curves to chords on the lattice, gathered into monotone runs.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <vtm/scene/affine.hpp>
#include <vtm/scene/path.hpp>
#include <vtm/scene/stroke.hpp>
#include "compiler/lower/area_chords.hpp"
#include "compiler/lower/lattice.hpp"

namespace vtm::compiler {

/// A directed straight edge of a layer's outline.
struct Chord {
    LatticePoint a, b;
};

/// Consecutive chords of one contour that nowhere turn back, in x or in y: points[first] to
/// points[last], first < last. A monotone chain meets every horizontal and vertical line once at
/// most and every square in one stretch, so all questions about it are binary searches.
struct Run {
    std::uint32_t first = 0, last = 0;
};

/// The contours of layers: points[run.first .. run.last] for every run. Runs of a contour follow each
/// other and share their end points.
struct Outlines {
    std::vector<LatticePoint> points;
    std::vector<Run> runs;

    Chord chord(std::uint32_t i) const { return {points[i], points[i + 1]}; }

    /// Calls visit(points) for each contour of some runs; its last point is its first.
    template <class Visit>
    void forEachContour(std::uint32_t firstRun, std::uint32_t runCount, const Visit& visit) const {
        for (std::uint32_t r = firstRun, end = firstRun + runCount; r < end;) {
            const std::uint32_t first = runs[r].first;
            std::uint32_t last = runs[r++].last;
            while (r < end && runs[r].first == last)
                last = runs[r++].last;
            visit(std::span(points).subspan(first, last + 1 - first));
        }
    }
};

/// Appends the closed contours of `path` under `toSteps` (path space to lattice steps): every subpath
/// is closed, every curve's chords lie within `tolerance` steps of it, every vertex is even, and what
/// lies outside [clampMin, clampMax] is moved onto that box's border, which changes no winding number
/// inside it.
void addOutline(Outlines& outlines, const scene::Path& path, const scene::Affine& toSteps,
                ChordTolerance tolerance, glm::dvec2 clampMin, glm::dvec2 clampMax);

/// Closed contours as chords that are not on the lattice yet.
struct FlatContours {
    std::vector<scene::Point> points;   ///< of each contour its start, then the ends of its chords
    std::vector<std::uint32_t> starts;  ///< numbers of points, ascending
    scene::Point min{0}, max{0};        ///< around the points
};

/// Those of `path` under `toSteps`.
FlatContours flatten(const scene::Path& path, const scene::Affine& toSteps, ChordTolerance tolerance);
/// Appends them moved by `by`, as addOutline() does; nothing, and returns false, unless all lie in the box.
bool addContours(Outlines& outlines, const FlatContours& contours, scene::Point by, glm::dvec2 clampMin,
                 glm::dvec2 clampMax);
/// Appends them cut at the box, as addOutline() does; their `min` and `max` do not matter.
void addCutContours(Outlines& outlines, const FlatContours& contours, glm::dvec2 clampMin,
                    glm::dvec2 clampMax);

/// A box in a path's space.
struct PathBox {
    scene::Point min, max;
};

/// So the outline of a stroke of `path`, within `strokeTolerance` and `chordTolerance` (strokeContours) in
/// path space; `tolerance`, in steps, is for the curves that it leaves. If all subpaths are closed and
/// without dashes, returns how many of the runs, the first ones, may stand for the outline of `path` itself:
/// beside the stroke they have the same winding numbers. With `near` the outline is right in that box only.
std::optional<std::uint32_t> addStroke(Outlines& outlines, const scene::Path& path,
                                       const scene::StrokeStyle& style, double strokeTolerance,
                                       ChordTolerance chordTolerance, const scene::Affine& toSteps,
                                       ChordTolerance tolerance, glm::dvec2 clampMin, glm::dvec2 clampMax,
                                       const std::optional<PathBox>& near = std::nullopt);

/// Tolerance, as a share of the given one, in path space: how much `m` stretches at most.
double largestStretch(const scene::Affine& m);

}  // namespace vtm::compiler
