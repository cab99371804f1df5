#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <tbb/task_arena.h>

#include <vtm/compiler/compile.hpp>
#include <vtm/compiler/draw_view.hpp>
#include "bench/engines/engine.hpp"
#include "bench/input/files.hpp"
#include "bench/measure/measure.hpp"
#include "bench/reports/reports.hpp"

namespace vtm::bench {
namespace {

/// False where the library compiles instead.
bool drawOnce(const scene::Scene& scene, const asset::View& view, std::vector<std::uint8_t>& bytes) {
    const std::size_t rowBytes = std::size_t(view.width) * 4;
    bytes.resize(rowBytes * std::size_t(view.height));
    const auto drawing = compiler::ViewDrawing::make(scene, view);
    if (drawing)
        drawing->draw({bytes.data(), rowBytes});
    return drawing != nullptr;
}

}  // namespace

Report threads(const Options& options) {
    measureWallTime();
    Report report;
    report.name = "threads";
    report.title = "One thread and all processors";
    report.text = fmt::format(
        "Wall milliseconds at {} pixels, with one thread and with {}, taking turns: compiling a scene, "
        "drawing it once without compiling, and drawing its asset again (`asset::Scanner`; "
        "`asset::Evaluator` where there are filters). In brackets the share of one thread's time: median and "
        "quartiles.",
        options.side, tbb::this_task_arena::max_concurrency());
    tbb::task_arena one(1);
    const Engines engines = scanEngines();
    Engine& engine = *engines.front();
    std::vector<std::uint8_t> bytes;
    std::map<std::string, std::vector<double>> shares;
    for (const File& file : filesOf(options)) {
        fmt::print(stderr, "{}\n", file.name);
        const LoadedFile picture{file, load(file)};
        engine.load(picture);
        const asset::View view = wholePicture(picture.scene, options.side);
        Json line = {{"file", file.name}};
        const auto measure = [&](const char* name, const std::function<void()>& step) {
            const double budget = options.quick ? 200 : 1000;
            const Paired times = pairwise([&] { one.execute(step); }, step, budget, 100);
            line[name] = fmt::format("{:.3g}, {:.3g} ({:.2f}: {:.2f}-{:.2f})", times.first, times.second,
                                     times.ratio, times.low, times.high);
            report.rows.push_back({{"file", file.name},
                                   {"step", name},
                                   {"one ms", times.first},
                                   {"all ms", times.second},
                                   {"share", times.ratio},
                                   {"low", times.low},
                                   {"high", times.high},
                                   {"pairs", times.pairs}});
            shares[name].push_back(times.ratio);
        };
        measure("compile", [&] { compiler::compile(picture.scene); });
        if (drawOnce(picture.scene, view, bytes))
            measure("drawn once", [&] { drawOnce(picture.scene, view, bytes); });
        else
            line["drawn once"] = "-";
        measure("drawn again", [&] { engine.draw(view); });
        report.summary.push_back(line);
    }
    Json medians = {{"file", "median"}};
    for (const auto& [name, values] : shares)
        medians[name] = fmt::format("{:.2f}", median(values));
    report.summary.push_back(medians);
    return report;
}

}  // namespace vtm::bench
