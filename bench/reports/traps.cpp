#include <cmath>

#include <fmt/core.h>

#include <vtm/compiler/draw_view.hpp>
#include <vtm/limits/limits.hpp>
#include <vtm/scene/fit.hpp>
#include <vtm/svg/load.hpp>
#include "bench/input/traps.hpp"
#include "bench/measure/measure.hpp"
#include "bench/reports/reports.hpp"

namespace vtm::bench {
namespace {

constexpr int pixels = 500;
constexpr double secondsAtMost = 60, bytesAtMost = 4e9;

/// From the file's bytes to pixels; throws limits::Exceeded, LimitError.
double drawOnce(const std::string& svg) {
    limits::Budget budget({.seconds = secondsAtMost, .memoryBytes = std::size_t(bytesAtMost)});
    const limits::Scope scope(budget);
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(svg.data());
    const svg::Document document = svg::load({bytes, svg.size()}, {});
    scene::Framing framing;
    framing.width = pixels;
    const auto drawing = compiler::ViewDrawing::make(
        document.scene, scene::frame(framing, document.scene.width, document.scene.height));
    image::Bitmap drawn{drawing->width(), drawing->height(), {}};
    drawn.rgba.resize(std::size_t(drawn.width) * std::size_t(drawn.height) * 4);
    drawing->draw({drawn.rgba.data(), std::size_t(drawn.width) * 4});
    double sum = 0;
    for (const std::uint8_t byte : drawn.rgba)
        sum += byte;
    return sum;
}

}  // namespace

Report traps(const Options& options) {
    Report report;
    report.name = "traps";
    report.title = "What is quadratic, drawn once";
    report.text = fmt::format(
        "Families of pictures in which n shapes meet far more often than n times, drawn once, {} pixels "
        "wide, from "
        "the bytes of the SVG file to pixels, each in a process of its own: CPU milliseconds on all cores, "
        "peak "
        "memory, and the exponent of the growth over the last tenfold n. What takes more than {} s or {} GB "
        "is left "
        "out.\n",
        pixels, secondsAtMost, bytesAtMost / 1e9);
    for (const TrapFamily& family : trapFamilies())
        report.text += fmt::format("\n- {}: {}", family.name, family.text);
    report.text += "\n";
    const int largest = options.quick ? 3 : 5;
    for (const TrapFamily& family : trapFamilies()) {
        Json line = {{"family", family.name}};
        double before = 0, exponent = 0;
        for (int e = 2; e <= largest; ++e) {
            const auto n = std::size_t(std::lround(std::pow(10, e)));
            std::string svg;
            const auto use = inChild([&] { svg = family.make(n); }, [&] { return drawOnce(svg); });
            const std::string name = fmt::format("10^{}", e);
            if (!use) {
                line[name + " ms"] = line[name + " MB"] = "-";
                before = 0;
                continue;
            }
            exponent = before > 0 ? std::log10(use->cpu / before) : 0;
            before = use->cpu;
            line[name + " ms"] = use->cpu;
            line[name + " MB"] = use->peakBytes / 1e6;
            report.rows.push_back({{"family", family.name},
                                   {"n", n},
                                   {"cpu ms", use->cpu},
                                   {"wall ms", use->wall},
                                   {"peak MB", use->peakBytes / 1e6},
                                   {"exponent", exponent}});
        }
        line["exponent"] = fmt::format("{:.2f}", exponent);
        report.summary.push_back(line);
    }
    return report;
}

}  // namespace vtm::bench
