#include "paper/compile/runs.hpp"

#include <algorithm>

#include <glm/geometric.hpp>

namespace vtm::paper {

namespace {

/// A clipped chord that shows, in cell coordinates.
struct Stretch {
    std::uint32_t chord;
    bool wholeStart, wholeEnd;  ///< not cut there
    Point a, b;
};

/// Three places are looked at, since another outline may cross.
bool isVisible(const Outline& outline, const CellTask& task, Point a, Point b, double offset) {
    const Point d = b - a, aside = Point(-d.y, d.x) * (offset / glm::length(d));
    return std::ranges::any_of(std::array{0.5, 0.05, 0.95}, [&](double s) {
        const Point p = a + d * s;
        return isInside(outline, task, p + aside) != isInside(outline, task, p - aside);
    });
}

std::vector<Stretch> visibleStretches(const Outline& outline, const CellTask& task, double offset) {
    const CellFrame frame(task);
    std::vector<Stretch> stretches;
    for (const std::uint32_t i : task.chords) {
        const Chord& chord = outline.chords[i];
        const ClippedChord cut = clip(chord, frame);
        const Point d = chord.b - chord.a;
        const Point a = frame.toCell(chord.a + d * cut.from), b = frame.toCell(chord.a + d * cut.to);
        if (a != b && isVisible(outline, task, a, b, offset))
            stretches.push_back({i, cut.from == 0, cut.to == 1, a, b});
    }
    return stretches;
}

struct OpenRun {
    Run points;
    Stretch first, last;
};

bool goesOn(const Outline& outline, const Stretch& before, const Stretch& after) {
    return before.wholeEnd && after.wholeStart && after.chord == before.chord + 1 &&
           outline.chords[before.chord].contour == outline.chords[after.chord].contour;
}

/// Whether `after` begins the contour that `before` ends.
bool closes(const Outline& outline, const Stretch& before, const Stretch& after) {
    const auto& chords = outline.chords;
    const std::uint32_t contour = chords[before.chord].contour;
    const bool ends = before.chord + 1 == chords.size() || chords[before.chord + 1].contour != contour;
    const bool begins = after.chord == 0 || chords[after.chord - 1].contour != contour;
    return ends && begins && chords[after.chord].contour == contour && before.wholeEnd && after.wholeStart;
}

/// A run that reaches a contour's end goes on in the one that begins there.
void joinAtContourStarts(const Outline& outline, std::vector<OpenRun>& runs) {
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const auto next = std::ranges::find_if(
            runs, [&](const OpenRun& r) { return closes(outline, runs[i].last, r.first); });
        const auto at = std::size_t(next - runs.begin());
        if (next == runs.end() || at == i)
            continue;
        runs[i].points.insert(runs[i].points.end(), next->points.begin() + 1, next->points.end());
        runs[i].last = next->last;
        runs.erase(next);
        return joinAtContourStarts(outline, runs);
    }
}

}  // namespace

bool isInside(const Outline& outline, const CellTask& task, Point inCell) {
    const Point p = CellFrame(task).toUnit(inCell);
    return outline.isInside(task.winding + windingChange(outline, task.chords, task.reference, p));
}

std::vector<Run> visibleRuns(const Outline& outline, const CellTask& task, double offset) {
    std::vector<OpenRun> open;
    for (const Stretch& s : visibleStretches(outline, task, offset)) {
        if (open.empty() || !goesOn(outline, open.back().last, s))
            open.push_back({{s.a}, s, s});
        open.back().points.push_back(s.b);
        open.back().last = s;
    }
    joinAtContourStarts(outline, open);
    std::vector<Run> runs;
    for (OpenRun& run : open)
        runs.push_back(std::move(run.points));
    return runs;
}

}  // namespace vtm::paper
