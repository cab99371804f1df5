/// \file
/// What compiling once and editing have in common: settings that follow from the options, and reports.
#pragma once

#include <vtm/compiler/compile.hpp>
#include "compiler/lower/lower.hpp"
#include "compiler/tree/tree.hpp"

namespace vtm::compiler {

/// Throws std::invalid_argument.
void checkOptions(const Options& options);
int latticeBits(const Options& options);
ErrorBudget errorBudget(const Options& options);
TreeOptions treeOptions(const Options& options);

/// Result::stages from milliseconds; `built`: since the scene was lowered.
std::vector<StageTime> stageTimes(double lowered, double built, const TreeTimes& times);
/// Adds to Result::provenError and Result::unproven what is known of a tree over the root square.
void certify(const Tree& tree, const ErrorBudget& budget, Result& result);
/// Asset::finestPixel of what has been certified.
double finestPixel(const Result& result);
/// Result::warnings; `colourError`: of encodePalette.
std::vector<std::string> warningsOf(const Result& result, const Options& options, float colourError);

class DrawnTiles;

/// As compile, which does it for the whole of a scene; that must be valid. `tiles`: of a pattern's tile,
/// which becomes an image (patterns/pattern_images.hpp).
Result compileExcerpt(const scene::Scene& scene, const Excerpt& excerpt, const Options& options,
                      DrawnTiles* tiles = nullptr);

}  // namespace vtm::compiler
