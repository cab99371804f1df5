/// \file
/// Paper mode: what a cell of the tree becomes.
#pragma once

#include <vector>

#include "paper/compile/outline.hpp"
#include "paper/model.hpp"

namespace vtm::paper {

/// A square of the mask's unit square, with what is known of it.
struct CellTask {
    Point corner{0};
    double side = 1;
    std::vector<std::uint32_t> chords;  ///< all that meet the cell with its margin, ascending
    Point reference{0};                 ///< a point in the cell
    int winding = 0;                    ///< there
};

/// The cell's square with its margin: cell coordinates to the unit square.
struct CellFrame {
    Point min;
    double side;
    explicit CellFrame(const CellTask& task)
        : min(task.corner - cellMargin * task.side), side(task.side * (1 + 2 * cellMargin)) {}
    Point toCell(Point p) const { return (p - min) / side; }
    Point toUnit(Point p) const { return min + p * side; }
};

/// The part of a chord within the frame.
struct ClippedChord {
    double from = 0, to = 0;
    bool empty() const { return !(from < to); }
};
ClippedChord clip(const Chord& chord, const CellFrame& frame);
/// The same within a box.
ClippedChord clip(const Chord& chord, Point min, Point max);

struct CellDecision {
    enum class Kind { Solid, Cell, Split };
    Kind kind = Kind::Split;
    bool inside = false;  ///< Solid
    Cell cell;
    bool approximated = false;
};

/// Two functions and one operator, chosen by comparing what they classify with the outline's winding
/// numbers at points of a grid and on both sides of the pieces: at a corner this finds the convex
/// or the reflex operator, at a crossing of a path with itself the union. Boundary
/// with the same inside on both sides is dropped first. Split where no choice classifies every point
/// rightly; on the last level the best choice is kept instead, and marked.
CellDecision decide(const Outline& outline, const CellTask& task, double tolerance, bool isLastLevel);

}  // namespace vtm::paper
