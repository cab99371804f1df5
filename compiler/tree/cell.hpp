/// \file
/// Cells: what of the picture passes through a square, divided down the 16-tree.
#pragma once

#include <array>
#include <vector>

#include "compiler/lower/lowered_scene.hpp"
#include "compiler/planar/clipped_run.hpp"

namespace vtm::compiler {

struct LayerWinding {
    std::uint32_t layer;
    int winding;
};

struct Cell {
    Square square;
    unsigned level = 0;
    std::vector<ClippedRun> clippedRuns;  ///< what passes through, ascending by layer
    std::vector<LayerWinding> windings;   ///< at the first corner, ascending by layer, zero left out

    /// Chords in the cell.
    std::size_t chordCount() const;
};

/// The given layers (ascending) in the root square.
Cell rootCell(const LoweredScene& picture, const Square& square, std::span<const std::uint32_t> layers);

/// The 16 children, row by row; their memory is used again.
void splitCell(Points points, const Cell& cell, std::array<Cell, 16>& children);

/// For messages: says that work is at a cell. Its place is that of the layer with the most chords in it,
/// or of the topmost one if it has no chords.
class AtCell {
public:
    AtCell(const char* stage, const LoweredScene& picture, const Cell& cell)
        : picture_(picture), cell_(cell), stage_(stage, place, this) {}

private:
    static limits::Place place(const void* self);

    const LoweredScene& picture_;
    const Cell& cell_;
    const limits::Stage stage_;
};

/// Replaces `layers` by the cell's layers, ascending.
void listLayers(const Cell& cell, std::vector<std::uint32_t>& layers);

}  // namespace vtm::compiler
