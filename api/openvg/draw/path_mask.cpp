#include "api/openvg/draw/path_mask.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "api/openvg/path/flatten.hpp"
#include "api/openvg/path/projective.hpp"
#include "api/openvg/state/matrix.hpp"
#include "compiler/coverage_map.hpp"
#include "compiler/outline_coverage.hpp"

namespace vtm::openvg {

namespace {

using glm::dvec2;

/// The picture that a mask is compiled as: as many units along its longer side, the outline a margin inside.
constexpr double pictureSide = 1024, pictureMargin = 1;

/// Shares of the longer side, good for 16, 256, 2048, 16384 and 262144 pixels. The last is the least that the
/// compiler proves.
constexpr std::array tolerances{1.0 / (1 << 10), 1.0 / (1 << 14), 1.0 / (1 << 17), 1.0 / (1 << 20),
                                1.0 / (1 << 24)};
constexpr double viewTolerance = 1.0 / (1 << 20);

/// A border may be off by this much of a pixel: 1/64 of it is 4/255 of the coverage along an edge at the very
/// worst, and the compiler's typical error is a tenth of its bound.
constexpr double pixelTolerance = 1.0 / 64;

/// Of outlines that take leaves: few pieces make a scanner fast, not short lists.
constexpr unsigned piecesPerLeaf = 4096;

/// Of one mask, in pairs of chords: a few seconds. No call may take a program's minute.
constexpr std::size_t maxWork = 1'000'000'000;

asset::CoverageScanner compiled(const std::shared_ptr<const scene::Path>& outline, scene::FillRule rule,
                                const scene::Affine& toPicture, dvec2 picture, double tolerance) {
    return asset::CoverageScanner(
        compiler::coverageMap(outline, rule, toPicture, picture,
                              {.tolerance = tolerance, .piecesPerLeaf = piecesPerLeaf, .maxWork = maxWork}));
}

/// Wider outlines are drawn as lines, few of them, where their curves would be cut finer and finer.
constexpr double maxPixels = double(1LL << 40);

std::shared_ptr<const scene::Path> asLines(const scene::Path& outline, const glm::mat3& toSurface) {
    auto lines = std::make_shared<scene::Path>();
    std::optional<dvec2> end;
    flatten(outline, toSurface, [&](dvec2 a, dvec2 b) {
        if (end != a)
            lines->emplace_back(scene::MoveTo{a});
        lines->emplace_back(scene::LineTo{b});
        end = b;
    });
    return lines;
}

/// Of the whole outline: scale and shift of its box into a picture.
struct Fit {
    double scale;
    dvec2 shift, picture;
};
Fit fitted(dvec2 min, dvec2 max) {
    const dvec2 extent = max - min;
    const double scale = (pictureSide - 2 * pictureMargin) / std::max(extent.x, extent.y);
    return {scale, dvec2(pictureMargin) - scale * min, scale * extent + 2 * pictureMargin};
}

std::uint64_t nextId() {
    static std::atomic<std::uint64_t> id = 0;
    return ++id;
}

}  // namespace

Rectangle pixelsOf(const glm::mat3& toSurface, dvec2 min, dvec2 max, const Rectangle& clip) {
    const glm::dmat3 m(toSurface);
    dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const dvec2 corner : {min, max, dvec2(min.x, max.y), dvec2(max.x, min.y)}) {
        const dvec2 p(m * glm::dvec3(corner, 1));
        if (!(std::isfinite(p.x) && std::isfinite(p.y)))
            return {};
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const auto whole = [](double v) { return int(std::clamp(v, -1e6, 1e6)); };
    return Rectangle{whole(std::floor(low.x)), whole(std::floor(low.y)), whole(std::ceil(high.x)),
                     whole(std::ceil(high.y))}
        .intersected(clip);
}

PathMask::PathMask(scene::Path outline, scene::FillRule rule)
    : id_(nextId()), outline_(std::make_shared<const scene::Path>(std::move(outline))), rule_(rule) {
    const geometry::Box box = boxOf(*outline_);
    if (!box.empty())
        min_ = box.min, max_ = box.max;
}

Rectangle PathMask::bounds(const glm::mat3& toSurface, const Rectangle& clip) const {
    return pixelsOf(toSurface, min_, max_, clip);
}

const asset::CoverageScanner& PathMask::scannerFor(double tolerance) {
    std::size_t i = 0;
    while (i + 1 < tolerances.size() && tolerances[i] > tolerance)
        ++i;
    std::optional<asset::CoverageScanner>& scanner = scanners_[i];
    if (!scanner) {
        const Fit fit = fitted(min_, max_);
        scanner = compiled(outline_, rule_, {fit.scale, 0, 0, fit.scale, fit.shift.x, fit.shift.y},
                           fit.picture, tolerances[i]);
    }
    return *scanner;
}

void PathMask::scan(const glm::mat3& toSurface, const Rectangle& clip, const RowSink& row) {
    if (!(max_.x > min_.x && max_.y > min_.y) || !isFinite(glm::dmat3(toSurface)))
        return;
    const Rectangle seen = bounds(toSurface, clip);
    if (seen.empty())
        return;
    asset::View view;
    view.width = seen.x1 - seen.x0;
    view.height = seen.y1 - seen.y0;
    std::vector<CoverageRun> moved;
    const auto onSurface = [&](int y, std::span<const CoverageRun> runs) {
        if (seen.x0 == 0)
            return row(y + seen.y0, runs);
        moved.assign(runs.begin(), runs.end());
        for (CoverageRun& run : moved) {
            run.first += seen.x0;
            run.end += seen.x0;
        }
        row(y + seen.y0, moved);
    };
    const glm::dmat3 m(toSurface);
    const dvec2 origin = dvec2(m[2]) - dvec2(seen.x0, seen.y0);
    const dvec2 extent = max_ - min_;
    const double stretch = std::max(glm::length(dvec2(m[0])), glm::length(dvec2(m[1])));
    const double pixels = stretch * std::max(extent.x, extent.y), tolerance = pixelTolerance / pixels;
    // Of such views doubles do not tell a curve from its rounding.
    const bool isForView = tolerance < tolerances.back();
    const bool areLines = pixels > maxPixels;
    if (isForView || !isScanned_) {
        isScanned_ = true;
        const std::shared_ptr<const scene::Path> outline =
            areLines ? asLines(*outline_, toSurface) : outline_;
        const scene::Affine toView = areLines ? scene::translation(-double(seen.x0), -double(seen.y0))
                                              : scene::Affine{dvec2(m[0]), dvec2(m[1]), origin};
        if (compiler::coverOutline(*outline, rule_, toView, view.width, view.height, onSurface))
            return;
        if (isForView) {
            // What lies outside of the view is cut off before anything is rounded.
            view.toPixels = scene::identity;
            return compiled(outline, rule_, toView, dvec2(view.width, view.height), viewTolerance)
                .scan(view, onSurface);
        }
    }
    const Fit fit = fitted(min_, max_);
    const dvec2 x = dvec2(m[0]) / fit.scale, y = dvec2(m[1]) / fit.scale;
    view.toPixels = {x, y, origin - x * fit.shift.x - y * fit.shift.y};
    scannerFor(tolerance).scan(view, onSurface);
}

void PathMask::scanCenters(const glm::mat3& toSurface, const Rectangle& clip, const RowSink& row) const {
    if (!isFinite(glm::dmat3(toSurface)))
        return;
    const Rectangle seen = bounds(toSurface, clip);
    if (seen.empty())
        return;
    // By row: columns from which on centres lie right of the line, and what that does to the winding.
    struct Crossing {
        int column, change;
    };
    std::vector<std::vector<Crossing>> rows(std::size_t(seen.y1 - seen.y0));
    flatten(*outline_, toSurface, [&](dvec2 a, dvec2 b) {
        int change = 1;
        if (a.y > b.y) {
            std::swap(a, b);
            change = -1;
        }
        // Centres with a.y <= y < b.y.
        const double from = std::max(std::ceil(a.y - 0.5), double(seen.y0)),
                     to = std::min(std::ceil(b.y - 0.5), double(seen.y1));
        for (double y = from; y < to; ++y) {
            const double x = a.x + (y + 0.5 - a.y) / (b.y - a.y) * (b.x - a.x);
            const double column = std::ceil(x - 0.5);
            if (column < seen.x1)
                rows[std::size_t(y - seen.y0)].push_back(
                    {std::max(int(std::max(column, -1e6)), seen.x0), change});
        }
    });
    std::vector<CoverageRun> runs;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        std::ranges::sort(rows[i], {}, &Crossing::column);
        runs.clear();
        int winding = 0, start = seen.x0;
        const auto close = [&](int end) {
            const bool inside = rule_ == scene::FillRule::NonZero ? winding != 0 : winding % 2 != 0;
            if (inside && start < end)
                runs.push_back({start, end, 1});
            start = end;
        };
        for (const Crossing& crossing : rows[i]) {
            close(crossing.column);
            winding += crossing.change;
        }
        close(seen.x1);
        if (!runs.empty())
            row(int(i) + seen.y0, runs);
    }
}

// ---- In perspective -------------------------------------------------------------------------------

struct PathMask::Seen {
    glm::mat3 toSurface;
    std::vector<ClipLine> lines;
    Rectangle clip;
    PathMask mask;
};

PathMask::~PathMask() = default;

PathMask& PathMask::seen(const glm::mat3& toSurface, const std::vector<glm::dvec3>& lines,
                         const Rectangle& clip) {
    if (!seen_ || seen_->toSurface != toSurface || seen_->lines != lines || seen_->clip != clip)
        seen_.reset(
            new Seen{toSurface, lines, clip, {projectedOutline(outline(), toSurface, lines, clip), rule_}});
    return seen_->mask;
}

}  // namespace vtm::openvg
