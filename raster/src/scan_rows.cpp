#include "raster/scan_rows.hpp"

#include <algorithm>
#include <cstring>
#include <vector>

#include <vtm/limits/limits.hpp>

namespace vtm::asset {
namespace {

/// Puts one pixel into all of `run`, by doubling what is there: few copies, most of them long.
void repeat(std::span<std::uint8_t> run, std::size_t pixelBytes) {
    for (std::size_t there = pixelBytes; there < run.size(); there *= 2)
        std::memcpy(&run[there], run.data(), std::min(there, run.size() - there));
}

/// As image::Raster has them; NaN becomes 0.
glm::vec4 clamped(const glm::vec4& color) {
    glm::vec4 result;
    for (int c = 0; c < 4; ++c)
        result[c] = color[c] > 0 ? std::min(color[c], 1.0f) : 0.0f;
    return result;
}

}  // namespace

void writeRun(const ColorRun& run, const image::PixelWriter& writer, std::span<std::uint8_t> row) {
    const std::size_t pixelBytes = writer.pixelBytes();
    const std::span bytes =
        row.subspan(std::size_t(run.first) * pixelBytes, std::size_t(run.end - run.first) * pixelBytes);
    const glm::vec4 color = clamped(run.color);
    writer.write(&color[0], bytes.data());
    repeat(bytes, pixelBytes);
}

void scanRows(const Scanner& scanner, const View& view, const image::PixelWriter& writer,
              const image::RowSink& sink) {
    std::vector<std::uint8_t> row(std::size_t(std::max(view.width, 0)) * writer.pixelBytes());
    scanner.scan(view, [&](int y, const ColorRun& run) {
        writeRun(run, writer, row);
        if (run.end != view.width)
            return;
        limits::progress(double(y + 1) / view.height);
        sink(row);
    });
}

void scanRows(const Evaluator& evaluator, const View& view, const image::PixelWriter& writer,
              const image::RowSink& sink) {
    std::vector<std::uint8_t> row(std::size_t(std::max(view.width, 0)) * writer.pixelBytes());
    evaluator.scan(view, [&](std::span<const float> colors) {
        image::writePixels(writer, colors.data(), colors.size() / 4, row.data());
        sink(row);
    });
}

}  // namespace vtm::asset
