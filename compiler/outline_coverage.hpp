/// \file
/// An outline and a view in, coverage out: no planar map between, which pays only for what is drawn again.
#pragma once

#include <functional>
#include <span>

#include <vtm/scene/affine.hpp>
#include <vtm/scene/path.hpp>
#include "raster/coverage.hpp"

namespace vtm::compiler {

/// Calls row(y, runs) for every row of [0, width] × [0, height] that is covered anywhere, as
/// asset::CoverageScanner::scan() does; `toPixels` maps the outline there. Sides are at most 2^14. Returns
/// false, without a call, for what takes too long this way.
bool coverOutline(const scene::Path& outline, scene::FillRule rule, const scene::Affine& toPixels, int width,
                  int height,
                  const std::function<void(int y, std::span<const asset::CoverageRun> runs)>& row);

}  // namespace vtm::compiler
