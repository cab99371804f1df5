/// \file
/// What is compiled or drawn for a raster: which excerpt of a scene, how exactly.
#pragma once

#include <optional>
#include <string>

#include <vtm/compiler/compile.hpp>
#include <vtm/compiler/view.hpp>
#include <vtm/raster/view.hpp>
#include <vtm/scene/affine.hpp>
#include <vtm/scene/fit.hpp>
#include <vtm/scene/scene.hpp>
#include "compiler/lower/lower.hpp"

namespace vtm::compiler {

struct ViewPlan {
    Excerpt excerpt;
    Options options;
    asset::View view;   ///< of the excerpt
    double pixel = 1;   ///< the shorter side of a pixel, in the excerpt's units
    double off = 0;     ///< by what the roundings of doubles may move boundaries, in those
    bool isAll = true;  ///< the excerpt is the whole scene

    /// A warning where roundings show.
    std::optional<std::string> warning() const;
};

/// As compileView() compiles it; nothing where nothing of the scene is seen. Throws as that does.
std::optional<ViewPlan> planView(const scene::Scene& scene, const scene::Frame& frame, const Options& options,
                                 double share = viewShare);
/// Where nothing is seen: a warning, unless the view lies beside the scene.
std::optional<std::string> warningOfNothing(const scene::Scene& scene, const scene::Frame& frame);

}  // namespace vtm::compiler
