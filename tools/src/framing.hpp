/// \file
/// How large the raster is and which part of the picture fills it.
#pragma once

#include <optional>

#include <CLI/CLI.hpp>

#include "asset/view.hpp"

namespace vtm::tools {

/// A rectangle in user units.
struct Rectangle {
    double x = 0, y = 0, width = 0, height = 0;
};

struct Framing {
    std::optional<int> width, height;
    double scale = 1;
    std::optional<Rectangle> part;
};

/// --width, --height, --scale, --view.
void addFramingOptions(CLI::App& command, Framing& framing);

/// The part (the whole picture where none was asked for) fills the raster. One dimension alone keeps
/// the aspect; none: one pixel a user unit, times the scale; rounded, at least one pixel.
/// Throws std::length_error beyond asset::maxViewSide and maxViewPixels.
asset::View frame(const Framing& framing, double pictureWidth, double pictureHeight);

}  // namespace vtm::tools
