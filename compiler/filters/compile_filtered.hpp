/// \file
/// A scene with filters in; out come pictures without filters, and the commands that filter and composite
/// them.
///
/// What of the scene has no filter in it stays together: neighbours in a group that have none are one
/// picture, exact and without seams. Groups with filters in them become commands: their children are drawn on
/// a picture of their own, filtered, clipped, masked and blended with what is below.
#pragma once

#include <functional>

#include <vtm/compiler/compile.hpp>
#include "compiler/lower/lower.hpp"

namespace vtm::compiler {

/// Whether a filter applies to the root or to anything in it.
bool hasFilters(const scene::Scene& scene);

/// Compiles a scene without filters.
using CompilePlain = std::function<Result(const scene::Scene&, const Excerpt&, const Options&)>;

/// As compile. The scene must be valid. With Options::filterPixels the picture has no filters but images.
Result compileFiltered(const scene::Scene& scene, const Excerpt& excerpt, const Options& options,
                       const CompilePlain& compilePlain);
/// The same, with the pictures that commands draw made otherwise: by `makePicture`, whose results have a map
/// and a command to draw it.
Result compileFiltered(const scene::Scene& scene, const Excerpt& excerpt, const Options& options,
                       const CompilePlain& compilePlain, const CompilePlain& makePicture);

}  // namespace vtm::compiler
