#include "compiler/outline_coverage.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <vtm/limits/limits.hpp>
#include "compiler/direct/pixel_row.hpp"
#include "compiler/lower/outline.hpp"

namespace vtm::compiler {
namespace {

using asset::CoverageRun;

/// Lattice steps a pixel: vertices are rounded to 2^-13 of one.
constexpr int pixelBits = 14;
constexpr double perStep = 1.0 / (1 << pixelBits);
constexpr int maxSide = 1 << (maxLatticeBits - pixelBits);

/// In pixels: curves that are one chord stray by this at most, others misplace this much of a pixel where
/// they pass through it, an eighth of a 255th. Some may pass through the same one.
constexpr double strayed = 1.0 / 1024, areaMisplaced = 1.0 / 2048;

/// Edges times the pixels that they pass through: about two seconds where these cross everywhere.
constexpr double maxPassages = 5'000'000;

glm::dvec2 placeOf(const LatticePoint& p) { return {p.x * perStep, p.y * perStep}; }

/// Of a monotone run, on its way up.
struct RunStrand : Strand<LatticePoint, placeOf> {
    using Strand::Strand;
    int row;  ///< in which it begins
};

RunStrand strandOf(const Outlines& outlines, Run run) {
    const LatticePoint *first = &outlines.points[run.first], *last = &outlines.points[run.last];
    const bool goesUp = first->y < last->y;
    if (!goesUp)
        std::swap(first, last);
    const int way = goesUp ? 1 : -1;
    RunStrand strand(first, last, way, way);
    strand.row = first->y >> pixelBits;
    return strand;
}

/// The strands of an outline, those that begin first first.
std::vector<RunStrand> strandsOf(const Outlines& outlines, int rows) {
    std::vector<RunStrand> strands;
    strands.reserve(outlines.runs.size());
    for (const Run& run : outlines.runs)
        strands.push_back(strandOf(outlines, run));
    std::erase_if(strands, [&](const RunStrand& s) { return s.row >= rows; });
    std::ranges::sort(strands, {}, &RunStrand::row);
    return strands;
}

/// How many pixels all edges pass through, counted by edge.
double passages(const Outlines& outlines) {
    double steps = 0;
    for (const Run& run : outlines.runs)
        steps += std::abs(double(outlines.points[run.last].x) - outlines.points[run.first].x) +
                 std::abs(double(outlines.points[run.last].y) - outlines.points[run.first].y);
    return steps * perStep + double(outlines.points.size());
}

}  // namespace

bool coverOutline(const scene::Path& outline, scene::FillRule rule, const scene::Affine& toPixels, int width,
                  int height, const std::function<void(int y, std::span<const CoverageRun> runs)>& row) {
    if (width > maxSide || height > maxSide)
        return false;
    constexpr double steps = 1 << pixelBits;
    Outlines outlines;
    const scene::Affine toSteps =
        scene::compose(scene::scaling(steps, steps),
                       scene::compose(scene::translation(PixelRow::outerColumns, 0), toPixels));
    addOutline(outlines, outline, toSteps, ChordTolerance(strayed, areaMisplaced).scaled(steps),
               glm::dvec2(0), glm::dvec2(PixelRow::outerColumns + width, height) * steps);
    if (passages(outlines) > maxPassages)
        return false;
    std::vector<RunStrand> strands = strandsOf(outlines, height);
    std::vector<int> active;
    PixelRow pixels(rule, width);
    std::size_t begun = 0;
    for (int y = 0; y < height && (begun < strands.size() || !active.empty()); ++y) {
        limits::check();
        for (; begun < strands.size() && strands[begun].row == y; ++begun)
            active.push_back(int(begun));
        if (active.empty())
            continue;
        pixels.begin(y);
        std::erase_if(active, [&](int i) { return !pixels.follow(strands[std::size_t(i)]); });
        const std::vector<CoverageRun>& runs = pixels.runs();
        if (!runs.empty())
            row(y, runs);
    }
    return true;
}

}  // namespace vtm::compiler
