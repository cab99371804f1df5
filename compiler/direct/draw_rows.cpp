#include "compiler/draw_rows.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>

#include <vtm/limits/limits.hpp>
#include "compiler/direct/band_sweep.hpp"
#include "compiler/direct/view_drawing.hpp"
#include "raster/chord.hpp"
#include "raster/scan_rows.hpp"

namespace vtm::compiler {
namespace {

/// Of rows that are drawn at once, by all processors.
constexpr std::size_t bytesAtOnce = 16u << 20;

}  // namespace

void drawRows(const ViewDrawing& drawing, const image::PixelWriter& writer, const image::RowSink& sink) {
    const std::size_t rowBytes = std::size_t(drawing.width()) * writer.pixelBytes();
    if (const asset::CommandPicture* drawn = DrawnPixels::of(drawing)) {
        const auto row = std::make_unique_for_overwrite<std::uint8_t[]>(rowBytes);
        return drawn->giveRows(0, drawing.height(), [&](std::span<const float> colors) {
            image::writePixels(writer, colors.data(), colors.size() / 4, row.get());
            sink({row.get(), rowBytes});
        });
    }
    constexpr int stripRows = stripBands * asset::bandRows;
    const auto strips = int(bytesAtOnce / std::max<std::size_t>(rowBytes * stripRows, 1));
    const int rows = std::min(std::max(strips, 1) * stripRows, drawing.height());
    const auto bytes = std::make_unique_for_overwrite<std::uint8_t[]>(std::size_t(rows) * rowBytes);
    const auto rowAt = [&](int row) { return std::span(&bytes[std::size_t(row) * rowBytes], rowBytes); };
    for (int first = 0; first < drawing.height(); first += rows) {
        const int end = std::min(first + rows, drawing.height());
        drawing.scan(first, end, [&](int y, const asset::ColorRun& run) {
            asset::writeRun(run, writer, rowAt(y - first));
        });
        for (int y = first; y < end; ++y) {
            limits::progress(double(y + 1) / drawing.height());
            sink(rowAt(y - first));
        }
    }
}

}  // namespace vtm::compiler
