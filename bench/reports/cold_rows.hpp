/// \file
/// Rows of pictures that are drawn once, from the file to pixels.
#pragma once

#include <string>

#include "bench/engines/contest.hpp"
#include "bench/measure/table.hpp"

namespace vtm::bench {

/// One picture, from its file: the milliseconds of each engine, and in brackets its share of ours. `heading`:
/// of the first column.
Json coldRow(Contenders& all, const CompiledFile& picture, const std::string& heading, const Options& options,
             std::vector<std::string>& notes);

/// Engines that are given paths alone read no file.
void removeEmptyColumns(const Contenders& all, Json& rows);

/// What the engines are, as a list.
std::string descriptionsOf(const Contenders& all);

}  // namespace vtm::bench
