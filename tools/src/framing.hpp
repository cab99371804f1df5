/// \file
/// The options that say how large the raster is and what of the picture it shows (vtm/scene/fit.hpp).
#pragma once

#include <CLI/CLI.hpp>

#include <vtm/raster/view.hpp>
#include <vtm/scene/fit.hpp>

namespace vtm::tools {

/// --width, --height, --zoom, --fit, --view, --rotate.
void addFramingOptions(CLI::App& command, scene::Framing& framing);

/// Throws std::length_error beyond asset::maxViewSide and maxViewPixels, with what to do about it.
scene::Frame frameOf(const scene::Framing& framing, double pictureWidth, double pictureHeight);

}  // namespace vtm::tools
