/// \file
/// A drawing of a view as rows of bytes.
#pragma once

#include <vtm/compiler/draw_view.hpp>
#include "image/pixel_writer.hpp"

namespace vtm::compiler {

/// Gives every row to the sink; holds some rows at a time. Calls limits::progress(). Throws as
/// ViewDrawing::scan and the sink do.
void drawRows(const ViewDrawing& drawing, const image::PixelWriter& writer, const image::RowSink& sink);

}  // namespace vtm::compiler
