/// \file
/// Compiling an excerpt of a scene.
#pragma once

#include <vtm/compiler/compile.hpp>
#include "compiler/lower/lower.hpp"

namespace vtm::compiler {

/// As compile, which does it for the whole of a scene; that must be valid.
Result compileExcerpt(const scene::Scene& scene, const Excerpt& excerpt, const Options& options);

}  // namespace vtm::compiler
