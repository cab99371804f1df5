/// \file
/// Pictures as rows of bytes.
#pragma once

#include <cstdint>
#include <span>

#include <vtm/raster/evaluator.hpp>
#include <vtm/raster/scan.hpp>
#include "image/pixel_writer.hpp"

namespace vtm::asset {

/// Writes a run of pixels into the bytes of its row.
void writeRun(const ColorRun& run, const image::PixelWriter& writer, std::span<std::uint8_t> row);

/// Gives every row of the view to the sink as soon as it is drawn; holds one, not the picture. Calls
/// limits::progress(). Throws as Scanner::scan and the sink do.
void scanRows(const Scanner& scanner, const View& view, const image::PixelWriter& writer,
              const image::RowSink& sink);
/// The same of an evaluator, which holds the picture.
void scanRows(const Evaluator& evaluator, const View& view, const image::PixelWriter& writer,
              const image::RowSink& sink);

}  // namespace vtm::asset
