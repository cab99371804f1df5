/// \file
/// Paper mode: the visible boundary inside a cell, as connected polylines.
#pragma once

#include "paper/compile/cell.hpp"

namespace vtm::paper {

using Run = std::vector<Point>;  ///< in cell coordinates, in the outline's direction

/// Whether a point of the cell, in cell coordinates, is inside the shape.
bool isInside(const Outline& outline, const CellTask& task, Point inCell);

/// Chords whose sides, `offset` cell coordinates away, differ in being inside; clipped to the cell with
/// its margin and joined where one goes on in the next.
std::vector<Run> visibleRuns(const Outline& outline, const CellTask& task, double offset);

}  // namespace vtm::paper
