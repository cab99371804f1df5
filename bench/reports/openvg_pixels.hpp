/// \file
/// Rows of the report on OpenVG: work that is pixels rather than outlines.
#pragma once

#include "bench/reports/reports.hpp"

namespace vtm::bench {

/// Adds a row for each kind of work; `spend` CPU milliseconds for each.
void addPixelRows(double spend, Report& report);

}  // namespace vtm::bench
