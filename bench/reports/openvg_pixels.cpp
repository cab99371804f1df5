// Images, gradients and copies: OpenVG against cairo where cairo has the same.

#include <algorithm>

#include <fmt/core.h>

#include "bench/engines/pixel_work.hpp"
#include "bench/measure/measure.hpp"
#include "bench/reports/openvg_pixels.hpp"
#include "bench/reports/openvg_shaders.hpp"

namespace vtm::bench {

namespace {

void addRowsOfBoth(double spend, Report& report) {
    const std::vector<PixelWork> ours = vgPixelWork(), cairo = cairoPixelWork();
    for (const PixelWork& work : ours) {
        Json row{{"workload", work.name}, {"shapes", ""}, {"first frame ms", ""}};
        int ourFrame = 0, cairoFrame = 0;
        // Several frames a turn: one takes less than the clock can tell.
        constexpr int frames = 8;
        const auto draw = [&](const PixelWork& w, int& frame) {
            for (int i = 0; i < frames; ++i)
                w.draw(++frame);
        };
        const auto peer = std::ranges::find(cairo, work.name, &PixelWork::name);
        const bool hasPeer = peer != cairo.end();
        const Paired paired = pairwise([&] { draw(hasPeer ? *peer : work, cairoFrame); },
                                       [&] { draw(work, ourFrame); }, spend, 100);
        row["cairo ms"] = hasPeer ? Json(paired.first / frames) : Json("");
        row["OpenVG ms"] = paired.second / frames;
        row["OpenVG / cairo"] = hasPeer ? Json(paired.ratio) : Json("");
        row["quartiles"] = hasPeer ? fmt::format("{:.2f} to {:.2f}", paired.low, paired.high) : "";
        report.rows.push_back(std::move(row));
    }
}

}  // namespace

void addPixelRows(double spend, Report& report) {
    const std::size_t first = report.rows.size();
    addRowsOfBoth(spend, report);
    const std::vector<PixelWork> byShaders = vgPixelWork(VTM_COMPOSITOR_GL);
    if (vtmGetCompositor(vtmGetCurrentSurface()) != VTM_COMPOSITOR_GL) {
        report.notes.push_back(std::string("by shaders: missing, ") + vtmGetCompositorFault());
        return;
    }
    for (std::size_t i = 0; i < byShaders.size(); ++i)
        addShaderColumns(byShaders[i].draw, spend, report.rows[first + i]);
}

}  // namespace vtm::bench
