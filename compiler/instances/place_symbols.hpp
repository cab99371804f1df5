/// \file
/// A lowered scene in; out come runs of layers that repeat as maps of their own, where they stand and what
/// paints their regions there, and the layers that are left.
///
/// An instance is made only where the picture around it and below it is of one paint (docs/instances.md): no
/// other outline touches its boundaries or lies in its regions. So a pixel is what the picture shows without
/// it, plus share · (paint - ground) for each of its regions.
#pragma once

#include <optional>
#include <span>

#include "compiler/instances/placed_symbols.hpp"
#include "compiler/instances/tiles.hpp"
#include "compiler/paint/palette.hpp"

namespace vtm::compiler {

/// `palette` gets the paints. Nothing if a pattern's tile could not be proven.
std::optional<PlacedSymbols> placeSymbols(const LoweredScene& picture, std::span<const LayerOrigin> origins,
                                          std::span<const TileFill> fills, const Lattice& lattice,
                                          glm::dvec2 size, const Options& options, Palette& palette);

}  // namespace vtm::compiler
