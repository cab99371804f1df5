/// \file
/// The texts of paper mode's programs.
#pragma once

#include <string>
#include <vector>

#include "backend_gl/core/features.hpp"
#include "backend_gl/core/program.hpp"

namespace vtm::paper {

/// What a fragment is of.
enum class Shown { View, Surface };

/// The recursion. `mips`: whether masks may be so small that theirs are read.
struct MapParts {
    Shown shown = Shown::View;
    bool mips = true;
    auto operator<=>(const MapParts&) const = default;
};
/// `materials`: their text (gl::materialsSource), if the features name them.
gl::ProgramSource mapSource(gl::Features features, const std::string& materials, MapParts parts);

/// Kinds of a pattern's squares; above Inside: cells of so many functions more.
enum class PatternKind : unsigned { Outside, Inside };

/// `cells`, `mip`: what it reads, a surface's always the cells; `depth`: levels of the tree, at least 1.
struct PatternParts {
    bool compressed = true, filtered = true, linear = false, cells = true, mip = true;
    unsigned depth = 1;
    Shown shown = Shown::View;
};
gl::ProgramSource patternSource(const PatternParts& parts);

/// Every program that there can be, without materials.
std::vector<gl::ProgramSource> everySource();

}  // namespace vtm::paper
