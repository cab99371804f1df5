#include "tools/engines/cpu_engine.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include <vtm/limits/limits.hpp>
#include <vtm/raster/scan.hpp>

namespace vtm::tools {

namespace {

/// Rows of the scanner's runs. Measures how long the sink takes, which is not drawing.
class ScannedRows {
public:
    ScannedRows(const asset::View& view, const Sheet& sheet, const RowSink& sink)
        : writer_(sheet),
          sink_(sink),
          width_(view.width),
          height_(view.height),
          pixelBytes_(sheet.pixelBytes()),
          row_(std::size_t(view.width) * pixelBytes_) {}

    void take(int y, const asset::ColorRun& run) {
        fill(run);
        if (run.end == width_)
            finishRow(y);
    }
    double sinkMilliseconds() const { return sinkMilliseconds_; }

private:
    void fill(const asset::ColorRun& run) {
        // In [0, 1], as image::Raster has them; NaN becomes 0.
        float color[4];
        for (int c = 0; c < 4; ++c)
            color[c] = run.color[c] > 0 ? std::min(run.color[c], 1.0f) : 0.0f;
        std::uint8_t* const first = &row_[std::size_t(run.first) * pixelBytes_];
        writer_.write(color, first);
        // Doubles what is there: few copies, most of them long.
        const std::size_t all = std::size_t(run.end - run.first) * pixelBytes_;
        for (std::size_t there = pixelBytes_; there < all; there *= 2)
            std::memcpy(first + there, first, std::min(there, all - there));
    }
    void finishRow(int y) {
        limits::progress(double(y + 1) / height_);
        sinkMilliseconds_ += millisecondsOf([&] { sink_(row_); });
    }

    const PixelWriter writer_;
    const RowSink& sink_;
    const int width_, height_;
    const std::size_t pixelBytes_;
    std::vector<std::uint8_t> row_;
    double sinkMilliseconds_ = 0;
};

}  // namespace

void CpuEngine::draw(Source& source, const asset::View& view, const Sheet& sheet, const RowSink& sink) {
    if (source.paper || !asset::isSumOfMaps(*source.asset))
        throw std::runtime_error("the cpu engine draws exact pictures only");
    if (!source.asset->materials.empty())
        warnOfMaterials(source);
    const asset::Scanner scanner =
        timed(source.stages, "upload", [&] { return asset::Scanner(*source.asset); });
    ScannedRows rows(view, sheet, sink);
    const double all = millisecondsOf(
        [&] { scanner.scan(view, [&](int y, const asset::ColorRun& run) { rows.take(y, run); }); });
    source.stages.emplace_back("render", all - rows.sinkMilliseconds());
}

}  // namespace vtm::tools
