#include <algorithm>
#include <cmath>
#include <limits>

#include "raster/coverage.hpp"
#include "raster/src/boundary_chords.hpp"
#include "raster/src/row_sums.hpp"

namespace vtm::asset {

namespace {

/// Mean of clamp(x, 0, 1) for x evenly between a and b. The integral is split at x = 1 instead of
/// subtracting antiderivatives, whose leading digits cancel where |x| is large.
float meanOfClamp(float a, float b) {
    const float low = std::min(a, b), high = std::max(a, b), span = high - low;
    const float clampedLow = std::clamp(low, 0.0f, 1.0f), clampedHigh = std::clamp(high, 0.0f, 1.0f);
    if (span < smallestSpan)
        return clampedLow;
    const float ramp = (clampedHigh - clampedLow) * (clampedHigh + clampedLow) * 0.5f;
    const float above = std::max(high, 1.0f) - std::max(low, 1.0f);
    return (ramp + above) / span;
}

float cross(glm::vec2 a, glm::vec2 b) { return a.x * b.y - a.y * b.x; }

glm::vec2 point(const std::array<std::uint16_t, 2>& p) { return {float(p[0]), float(p[1])}; }

/// A piece in the pixel's coordinates: P(s) = a + s·chord + t(s)·normal.
struct Curve {
    glm::vec2 a, b, chord, normal;
    float slopeA, slopeB;

    glm::vec2 at(float s) const {
        const float r = 1 - s;
        return a + s * chord + s * r * (slopeA * r - slopeB * s) * normal;
    }
    /// Off the curve by -h² t''(s) / 12, the mean of what a chord of that step h between its points misses.
    glm::vec2 lifted(float s, float h) const {
        return at(s) + h * h / 6 * (2 * slopeA + slopeB - 3 * s * (slopeA + slopeB)) * normal;
    }
};

Curve curveOf(const LeafFrame& frame, const Piece& piece) {
    const glm::vec2 a = point(piece.a), b = point(piece.b), d = b - a;
    return {frame(a),
            frame(b),
            frame.linear * d,
            frame.linear * glm::vec2(-d.y, d.x),
            float(piece.slopeA) / slopeScale,
            float(piece.slopeB) / slopeScale};
}

struct Range {
    float from = 0, to = 0;
    bool empty() const { return !(from < to); }
};

/// The s for which P(s) can lie in the pixel's box. s and t are linear in the pixel's coordinates, so
/// the box spans an interval of each; |t| <= 4/27 (|slopeA| + |slopeB|), as s(1-s)² <= 4/27.
Range rangeInBox(const Curve& curve) {
    const float area = cross(curve.chord, curve.normal);
    const float bulge = 4.0f / 27 * (std::abs(curve.slopeA) + std::abs(curve.slopeB));
    if (area == 0 || bulge == 0)
        return {};
    const glm::vec2 toCentre = glm::vec2(0.5f) - curve.a;
    const float halfS = 0.5f * (std::abs(curve.normal.x) + std::abs(curve.normal.y)) / std::abs(area);
    const float halfT = 0.5f * (std::abs(curve.chord.x) + std::abs(curve.chord.y)) / std::abs(area);
    if (std::abs(cross(curve.chord, toCentre) / area) > bulge + halfT)
        return {};
    const float s = cross(toCentre, curve.normal) / area;
    return {std::clamp(s - halfS, 0.0f, 1.0f), std::clamp(s + halfS, 0.0f, 1.0f)};
}

/// What lies between a curve and its chord outside the box adds nothing, so one chord serves there.
float curveSum(const Curve& curve) {
    const Range range = rangeInBox(curve);
    if (range.empty())
        return seg(curve.a, curve.b);
    glm::vec2 last = curve.a;
    float sum = 0;
    const float step = (range.to - range.from) / chordCount;
    for (int i = 0; i <= chordCount; ++i) {
        const glm::vec2 next =
            curve.lifted(range.from + (range.to - range.from) * (float(i) / chordCount), step);
        sum += seg(last, next);
        last = next;
    }
    return sum + seg(last, curve.b);
}

float alongSide(int side, glm::vec2 from, const Corners& corners) {
    return side < 0 ? 0 : seg(from, corners[std::size_t(side) + 1]);
}

}  // namespace

Corners cornersOf(const LeafFrame& frame) {
    constexpr float e = leafExtent;
    return {frame({0, 0}), frame({e, 0}), frame({e, e}), frame({0, e}), frame({0, 0})};
}

float seg(glm::vec2 p, glm::vec2 q) {
    const float y0 = std::clamp(p.y, 0.0f, 1.0f), y1 = std::clamp(q.y, 0.0f, 1.0f);
    if (y0 == y1)
        return 0;
    const glm::vec2 d = q - p;
    const float x0 = p.x + d.x * ((y0 - p.y) / d.y), x1 = q.x + d.x * ((y1 - q.y) / d.y);
    return (y1 - y0) * meanOfClamp(x0, x1);
}

float pieceSum(const LeafFrame& frame, const Corners& corners, const Piece& piece) {
    const Curve curve = curveOf(frame, piece);
    return curveSum(curve) + alongSide(sideOf(piece.b), curve.b, corners) -
           alongSide(sideOf(piece.a), curve.a, corners);
}

namespace {

/// What one mask needs and the next uses again.
struct Scratch {
    Bands bands;
    Accumulator<float> coverage;
    std::vector<CoverageRun> runs;
    bool isWhole = true;  ///< false while sums may be half done
};

/// Not inlined: a shared library would ask for the thread's address at every use.
[[gnu::noinline]] Scratch& scratchOfThread() {
    thread_local Scratch scratch;
    if (!scratch.isWhole)
        scratch = {};
    return scratch;
}

}  // namespace

struct CoverageScanner::Drawn {
    MapPlace place;
    Boundaries boundaries;  ///< with paint 1 on one side and 0 on the other
};

CoverageScanner::CoverageScanner(const AssetView& mask) {
    for (const PlanarMap& map : planarMaps(mask))
        add(map);
}

CoverageScanner::CoverageScanner(const PlanarMap& mask) { add(mask); }

void CoverageScanner::add(const PlanarMap& mask) {
    std::vector<PlanarPiece> pieces;
    for (PlanarPiece piece : mask.pieces) {
        if ((piece.left == 0) == (piece.right == 0))
            continue;
        piece.left = piece.left != 0;
        piece.right = piece.right != 0;
        pieces.push_back(piece);
    }
    drawn_.push_back({mask, Boundaries(pieces)});
}

CoverageScanner::~CoverageScanner() = default;
CoverageScanner::CoverageScanner(CoverageScanner&&) noexcept = default;
CoverageScanner& CoverageScanner::operator=(CoverageScanner&&) noexcept = default;

void CoverageScanner::scan(const View& view,
                           const std::function<void(int, std::span<const CoverageRun>)>& row) const {
    validate(view);
    const double determinant = glm::determinant(glm::dmat2(view.toPixels[0], view.toPixels[1]));
    if (!(std::abs(determinant) > std::numeric_limits<double>::min()))
        return;
    Scratch& scratch = scratchOfThread();
    scratch.isWhole = false;
    scratch.bands.clear(view.height);
    for (const Drawn& drawn : drawn_) {
        auto chords = chordsOf(drawn.place, view, scratch.bands);
        chords.add(drawn.boundaries);
    }
    scratch.coverage.resize(view.width);
    for (int band = 0; band * bandRows < view.height; ++band) {
        const std::span<const Chord> chords = scratch.bands.of(band);
        if (chords.empty())
            continue;
        const int top = band * bandRows, rows = std::min(bandRows, view.height - top);
        for (const Chord& c : chords)
            scratch.coverage.add(c, float(top), rows, float(c.left) - float(c.right));
        for (int y = 0; y < rows; ++y) {
            scratch.runs.clear();
            scratch.coverage.resolve(std::size_t(y), [&](int first, int end, float share) {
                if (share > minShare)
                    scratch.runs.push_back({first, end, std::min(share, 1.0f)});
            });
            if (!scratch.runs.empty())
                row(top + y, scratch.runs);
        }
    }
    scratch.isWhole = true;
}

}  // namespace vtm::asset
