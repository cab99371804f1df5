#include "raster/coverage_scan.hpp"

#include <cmath>
#include <limits>

#include "raster/src/row_sums.hpp"

namespace vtm::asset {

namespace {

/// What one mask needs and the next uses again.
struct Scratch {
    Bands bands;
    Accumulator<Wholes<float>> coverage;
    std::vector<CoverageRun> runs;
    bool isWhole = true;  ///< false while sums may be half done
};

Scratch& scratchOfThread() {
    thread_local Scratch scratch;
    if (!scratch.isWhole)
        scratch = {};
    return scratch;
}

}  // namespace

struct CoverageScanner::Drawn {
    MapPlace place;
    std::vector<Boundary> boundaries;  ///< with paint 1 on one side and 0 on the other
};

CoverageScanner::CoverageScanner(const AssetView& mask) {
    for (const PlanarMap& map : planarMaps(mask))
        add(map);
}

CoverageScanner::CoverageScanner(const PlanarMap& mask) { add(mask); }

void CoverageScanner::add(const PlanarMap& mask) {
    Drawn drawn{mask, {}};
    drawn.boundaries.reserve(mask.pieces.size());
    for (PlanarPiece piece : mask.pieces) {
        if ((piece.left == 0) == (piece.right == 0))
            continue;
        piece.left = piece.left != 0;
        piece.right = piece.right != 0;
        drawn.boundaries.emplace_back(piece);
    }
    drawn_.push_back(std::move(drawn));
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
        Chords chords(drawn.place, view, scratch.bands);
        for (const Boundary& boundary : drawn.boundaries)
            chords.add(boundary);
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
