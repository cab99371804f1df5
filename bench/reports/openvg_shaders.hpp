/// \file
/// Columns of the report on OpenVG: the same frames drawn by shaders.
#pragma once

#include <functional>

#include "bench/reports/reports.hpp"

namespace vtm::bench {

/// What a frame costs in CPU milliseconds where GL's compositor draws it, medians: of all threads, which on a
/// software driver run the shaders too, and of the program's own. `draw` draws frame i on a surface of that
/// compositor.
void addShaderColumns(const std::function<void(int i)>& draw, double spend, Json& row);

}  // namespace vtm::bench
