/// \file
/// Rows of a table: a picture each, a column for each engine.
#pragma once

#include <string>

#include "bench/engines/contest.hpp"
#include "bench/measure/table.hpp"

namespace vtm::bench {

inline constexpr Kind cold{.name = "cold", .moving = false, .cold = true};  ///< from the file to pixels
inline constexpr Kind again{.name = "again", .moving = false};              ///< what was drawn before

/// One picture, `options.side` wide: the milliseconds of each engine, and in brackets its share of ours.
/// `heading`: of the first column.
Json pictureRow(Contenders& all, const LoadedFile& picture, const Kind& kind, const std::string& heading,
                const Options& options, std::vector<std::string>& notes);

/// Those of engines that drew none of the pictures.
void removeEmptyColumns(const Contenders& all, Json& rows);

/// What the engines are, as a list.
std::string descriptionsOf(const Contenders& all);

}  // namespace vtm::bench
