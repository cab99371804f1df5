#include "api/openvg/path/projective.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <VG/vgext.h>

namespace vtm::openvg {

namespace {

using glm::dvec3;

/// Of outlines on the surface.
constexpr double projectedTolerance = 1.0 / 256;
/// Around what is drawn: lines along the border of the view must not touch its pixels.
constexpr double viewMargin = 2;
/// Of a curve where it meets a line; halving as often leaves nothing between.
constexpr int maxProjectedHalvings = 50;

/// Numbers of Bernstein's form over [first, last].
struct Values {
    int degree;
    std::array<double, 4> at;
    double first, last;

    int changes() const {
        int count = 0;
        double before = 0;
        for (std::size_t i = 0; i <= std::size_t(degree); ++i) {
            count += before * at[i] < 0;
            if (at[i] != 0)
                before = at[i] < 0 ? -1 : 1;
        }
        return count;
    }
    std::pair<Values, Values> halves() const {
        Values a = *this, b = *this;
        const auto n = std::size_t(degree);
        for (std::size_t k = 1; k <= n; ++k) {
            for (std::size_t i = n; i >= k; --i)
                a.at[i] = (a.at[i - 1] + a.at[i]) / 2;
            for (std::size_t i = 0; i + k <= n; ++i)
                b.at[i] = (b.at[i] + b.at[i + 1]) / 2;
        }
        a.last = b.first = (first + last) / 2;
        return {a, b};
    }
};

/// Appends the places where the sign changes, in order: a polynomial changes its sign no more often than its
/// Bernstein coefficients do.
void addRoots(const Values& values, int halvings, std::vector<double>& roots) {
    if (values.changes() == 0)
        return;
    if (values.degree == 1) {
        roots.push_back(values.first +
                        (values.last - values.first) * values.at[0] / (values.at[0] - values.at[1]));
        return;
    }
    if (halvings == maxProjectedHalvings) {
        roots.push_back(values.first);
        return;
    }
    const auto [a, b] = values.halves();
    addRoots(a, halvings + 1, roots);
    // Neither half sees a root that is just the middle.
    const double left = a.at[0], right = b.at[std::size_t(b.degree)];
    if (b.at[0] == 0 && left * right < 0 && a.changes() == 0 && b.changes() == 0)
        roots.push_back(b.first);
    addRoots(b, halvings + 1, roots);
}

struct CurvePart {
    RationalCurve curve;
    bool isKept;
};

/// From one change of sides to the next.
std::vector<CurvePart> pieces(const RationalCurve& curve, ClipLine line) {
    Values values{curve.degree, {}, 0, 1};
    for (std::size_t i = 0; i <= std::size_t(curve.degree); ++i)
        values.at[i] = glm::dot(line, curve.points[i]);
    std::vector<double> cuts{0};
    addRoots(values, 0, cuts);
    cuts.push_back(1);
    std::vector<CurvePart> result;
    double first = 0;
    for (std::size_t i = 1; i < cuts.size(); ++i) {
        const auto isKept = [&](std::size_t end) {
            return glm::dot(line, curve.at((cuts[end - 1] + cuts[end]) / 2)) >= 0;
        };
        if (i + 1 < cuts.size() && isKept(i) == isKept(i + 1))
            continue;
        if (first < cuts[i])
            result.push_back({curve.part(first, cuts[i]), isKept(i)});
        first = cuts[i];
    }
    return result;
}

RationalCurve lineBetween(dvec3 a, dvec3 b) { return {1, {a, b}}; }

std::vector<RationalCurve> withClosing(const RationalSubpath& subpath) {
    std::vector<RationalCurve> curves = subpath.curves;
    if (!curves.empty() && curves.back().end() != subpath.start)
        curves.push_back(lineBetween(curves.back().end(), subpath.start));
    return curves;
}

/// Stretches that are kept, one after the other; nothing if all of the curves are.
struct Kept {
    bool isAll = true;
    std::vector<std::vector<RationalCurve>> runs;
    bool startsAtStart = false, endsAtEnd = false;
};
Kept kept(const std::vector<RationalCurve>& curves, ClipLine line) {
    Kept result;
    bool wasKept = false, isFirst = true;
    for (const RationalCurve& curve : curves)
        for (CurvePart& piece : pieces(curve, line)) {
            if (piece.isKept) {
                if (!wasKept)
                    result.runs.emplace_back();
                result.runs.back().push_back(piece.curve);
            }
            if (std::exchange(isFirst, false))
                result.startsAtStart = piece.isKept;
            result.isAll = result.isAll && piece.isKept;
            wasKept = piece.isKept;
        }
    result.endsAtEnd = wasKept;
    return result;
}

RationalPath byLine(const RationalPath& path, ClipLine line, bool isArea) {
    RationalPath result;
    for (const RationalSubpath& subpath : path) {
        if (subpath.curves.empty()) {
            if (glm::dot(line, subpath.start) >= 0)
                result.push_back(subpath);
            continue;
        }
        Kept part = kept(isArea || subpath.isClosed ? withClosing(subpath) : subpath.curves, line);
        if (part.isAll) {
            result.push_back(subpath);
            continue;
        }
        if (part.runs.empty())
            continue;
        if (isArea) {
            RationalSubpath& area =
                result.emplace_back(RationalSubpath{part.runs.front().front().start(), {}, true});
            for (const auto& run : part.runs) {
                if (!area.curves.empty() && area.curves.back().end() != run.front().start())
                    area.curves.push_back(lineBetween(area.curves.back().end(), run.front().start()));
                area.curves.insert(area.curves.end(), run.begin(), run.end());
            }
            continue;
        }
        // Through the start of a closed subpath the line goes on.
        if (subpath.isClosed && part.startsAtStart && part.endsAtEnd && part.runs.size() > 1) {
            auto& last = part.runs.back();
            last.insert(last.end(), part.runs.front().begin(), part.runs.front().end());
            part.runs.erase(part.runs.begin());
        }
        for (auto& run : part.runs)
            result.push_back({run.front().start(), std::move(run), false});
    }
    return result;
}

/// Before all four lies nothing that is not before the viewer too: of opposite ones the sum says w >= 0.
std::array<ClipLine, 4> viewLines(glm::dvec2 minimum, glm::dvec2 maximum) {
    return {ClipLine(1, 0, -minimum.x), ClipLine(-1, 0, maximum.x), ClipLine(0, 1, -minimum.y),
            ClipLine(0, -1, maximum.y)};
}

}  // namespace

std::vector<ClipLine> clipLines(const State& state) {
    std::vector<ClipLine> lines;
    if (state.clipMode != VG_CLIPMODE_NONE_NDS)
        for (std::size_t i = 0; i + 3 <= state.clipLines.size(); i += 3)
            lines.emplace_back(state.clipLines[i], state.clipLines[i + 1], state.clipLines[i + 2]);
    return lines;
}

RationalPath mapped(const std::vector<Segment>& segments, const glm::mat3& toSurface) {
    const glm::dmat3 m(toSurface);
    RationalPath path;
    bool isOpen = false;
    const auto begin = [&](Point at) {
        path.push_back({m * dvec3(at, 1), {}, false});
        isOpen = true;
    };
    for (const Segment& s : segments) {
        if (s.type == VG_MOVE_TO) {
            begin(s.to);
            continue;
        }
        if (!isOpen)
            begin(s.from);
        if (s.type == VG_CLOSE_PATH) {
            path.back().isClosed = true;
            isOpen = false;
            continue;
        }
        for (RationalCurve curve : rationalCurves(s)) {
            for (dvec3& p : curve.points)
                p = m * p;
            path.back().curves.push_back(curve);
        }
    }
    return path;
}

bool isWithin(const RationalPath& path, std::span<const ClipLine> lines) {
    return std::ranges::all_of(lines, [&](ClipLine line) {
        return std::ranges::all_of(path, [&](const RationalSubpath& subpath) {
            return glm::dot(line, subpath.start) >= 0 && kept(subpath.curves, line).isAll;
        });
    });
}

RationalPath clippedArea(RationalPath path, std::span<const ClipLine> lines) {
    for (const ClipLine line : lines)
        path = byLine(path, line, true);
    return path;
}

RationalPath clippedLine(RationalPath path, std::span<const ClipLine> lines) {
    for (const ClipLine line : lines)
        path = byLine(path, line, false);
    return path;
}

scene::Path projectedOutline(const scene::Path& outline, const glm::mat3& toSurface,
                             std::span<const ClipLine> lines, const Rectangle& clip) {
    const glm::dvec2 minimum = glm::dvec2(clip.x0, clip.y0) - viewMargin,
                     maximum = glm::dvec2(clip.x1, clip.y1) + viewMargin;
    const RationalPath path =
        clippedArea(clippedArea(mapped(segmentsOf(outline), toSurface), lines), viewLines(minimum, maximum));
    std::vector<Segment> segments;
    for (const RationalSubpath& subpath : path) {
        Segment move;
        move.type = VG_MOVE_TO;
        move.to = projected(subpath.start);
        segments.push_back(move);
        for (const RationalCurve& curve : subpath.curves)
            appendAsPlain(segments, curve, projectedTolerance);
    }
    // At the viewer, where w is 0, rounding decides what x / w is.
    for (Segment& s : segments)
        s.to = glm::clamp(s.to, minimum, maximum);
    return vtm::openvg::outline(segments);
}

std::vector<Segment> projectedSegments(const std::vector<Segment>& segments, const glm::mat3& toSurface,
                                       const State& state) {
    const std::vector<ClipLine> lines = clipLines(state);
    RationalPath path = mapped(segments, toSurface);
    if (state.clipMode == VG_CLIPMODE_CULL_NDS && !isWithin(path, lines))
        return {};
    if (state.clipMode == VG_CLIPMODE_CLIP_CLOSED_NDS)
        path = clippedArea(std::move(path), lines);
    if (state.clipMode == VG_CLIPMODE_CLIP_OPEN_NDS)
        path = clippedLine(std::move(path), lines);
    std::vector<Segment> result;
    for (const RationalSubpath& subpath : path) {
        Segment move;
        move.type = VG_MOVE_TO;
        move.to = projected(subpath.start);
        result.push_back(move);
        for (const RationalCurve& curve : subpath.curves)
            result.push_back(segmentOf(curve));
        if (subpath.isClosed)
            result.push_back({});
    }
    return result;
}

}  // namespace vtm::openvg
