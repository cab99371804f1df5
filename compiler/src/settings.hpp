/// \file
/// What compiling once and editing have in common: settings that follow from the options, and reports.
#pragma once

#include "compiler/compile.hpp"
#include "compiler/src/tree.hpp"

namespace vtm::compiler {

/// Throws std::invalid_argument.
void checkOptions(const Options& options);
int latticeBits(const Options& options);
/// How far chords may lie from their curves, lattice steps.
double chordTolerance(const Options& options);
TreeOptions treeOptions(const Options& options);

/// Result::stages from milliseconds; `built`: since the scene was lowered.
std::vector<StageTime> stageTimes(double lowered, double built, const TreeTimes& times);
/// Result::warnings; `colourError`: of encodePalette.
std::vector<std::string> warningsOf(const asset::Asset& asset, float colourError);

}  // namespace vtm::compiler
