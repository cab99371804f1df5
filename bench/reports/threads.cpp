#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <tbb/task_arena.h>

#include <vtm/compiler/compile.hpp>
#include <vtm/compiler/draw_view.hpp>
#include <vtm/raster/evaluator.hpp>
#include <vtm/raster/scan.hpp>
#include "bench/input/files.hpp"
#include "bench/measure/measure.hpp"
#include "bench/reports/reports.hpp"

namespace vtm::bench {
namespace {

/// What is asked of a picture, all of it on the CPU.
class Steps {
public:
    Steps(const File& file, int side)
        : scene_(load(file)),
          view_(wholePicture(scene_, side)),
          asset_(compiler::compile(scene_).asset),
          bytes_(std::size_t(view_.width) * std::size_t(view_.height) * 4) {
        if (asset_.filters.empty())
            scanner_.emplace(asset_);
        else
            evaluator_.emplace(asset_);
    }

    void compile() const { compiler::compile(scene_); }
    /// False where the library compiles instead.
    bool drawOnce() {
        const auto drawing = compiler::ViewDrawing::make(scene_, view_);
        if (drawing)
            drawing->draw(target());
        return drawing != nullptr;
    }
    void drawAgain() {
        if (scanner_)
            scanner_->draw(view_, target());
        else
            evaluator_->draw(view_, target());
    }

private:
    asset::ByteTarget target() { return {bytes_.data(), std::size_t(view_.width) * 4}; }

    const scene::Scene scene_;
    const asset::View view_;
    const asset::Asset asset_;
    std::vector<std::uint8_t> bytes_;
    std::optional<asset::Scanner> scanner_;
    std::optional<asset::Evaluator> evaluator_;  ///< of what has filters
};

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
    std::map<std::string, std::vector<double>> shares;
    for (const File& file : filesOf(options)) {
        fmt::print(stderr, "{}\n", file.name);
        Steps steps(file, options.side);
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
        measure("compile", [&] { steps.compile(); });
        if (steps.drawOnce())
            measure("drawn once", [&] { steps.drawOnce(); });
        else
            line["drawn once"] = "-";
        measure("drawn again", [&] { steps.drawAgain(); });
        report.summary.push_back(line);
    }
    Json medians = {{"file", "median"}};
    for (const auto& [name, values] : shares)
        medians[name] = fmt::format("{:.2f}", median(values));
    report.summary.push_back(medians);
    return report;
}

}  // namespace vtm::bench
