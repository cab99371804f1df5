/// \file
/// How much a mask covers of every pixel: the Scanner's sums (vtm/raster/scan.hpp) without colours, for
/// renderers that bring their own.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include <vtm/asset/asset.hpp>
#include <vtm/raster/view.hpp>
#include "raster/planar_map.hpp"

namespace vtm::asset {

/// Columns first to end - 1 of a row, all covered by the same share.
struct CoverageRun {
    int first, end;
    float share;  ///< in (0, 1]
};

/// Of all that is not paint 0. Safe to use from several threads at once.
class CoverageScanner {
public:
    /// std::invalid_argument unless `mask` is a sum of maps. Keeps nothing of it.
    explicit CoverageScanner(const AssetView& mask);
    explicit CoverageScanner(const PlanarMap& mask);
    ~CoverageScanner();
    CoverageScanner(CoverageScanner&&) noexcept;
    CoverageScanner& operator=(CoverageScanner&&) noexcept;

    /// Calls row(y, runs) for every row of the view that is covered anywhere, from the first on; the runs
    /// from left to right, where something is covered. Throws std::length_error if the view is beyond its
    /// limits.
    void scan(const View& view,
              const std::function<void(int y, std::span<const CoverageRun> runs)>& row) const;

private:
    struct Drawn;

    void add(const PlanarMap& mask);

    std::vector<Drawn> drawn_;
};

}  // namespace vtm::asset
