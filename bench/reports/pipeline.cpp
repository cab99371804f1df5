// From the file to the first frame, by Google Benchmark.

#include <memory>

#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <vtm/compiler/compile.hpp>
#include <vtm/gl/renderer.hpp>
#include "bench/input/files.hpp"
#include "bench/measure/google.hpp"
#include "bench/measure/measure.hpp"
#include "bench/reports/reports.hpp"

namespace vtm::bench {
namespace {

using benchmark::Counter;

struct Gl {
    gl::Context context;
    gl::Renderer renderer{{.pixels = gl::Pixels::Shaders, .programCache = {}, .resetStatus = {}}};
};

/// Counters: wall milliseconds of every step, bytes and pieces.
void passThrough(benchmark::State& state, const File& file, int side, Gl& gl) {
    std::map<std::string, double> sums;
    asset::Summary summary;
    for (auto _ : state) {
        double last = wallMilliseconds();
        const auto lap = [&](const char* step) {
            const double now = wallMilliseconds();
            sums[step] += now - last;
            last = now;
        };
        const scene::Scene scene = load(file);
        lap("parse");
        const compiler::Result result = compiler::compile(scene);
        for (const compiler::StageTime& stage : result.stages)
            sums[stage.stage] += stage.milliseconds;
        last = wallMilliseconds();
        const gl::Texture texture = gl.renderer.upload(result.asset);
        lap("upload");
        gl.renderer.draw(texture, wholePicture(scene, side));
        lap("first frame");
        summary = asset::summarize(result.asset);
    }
    for (const auto& [step, sum] : sums)
        state.counters[step] = Counter(sum, Counter::kAvgIterations);
    state.counters["bytes"] = double(summary.bytes);
    state.counters["pieces"] = double(summary.pieces);
}

}  // namespace

Report pipeline(const Options& options) {
    const auto gl = std::make_shared<Gl>();
    Report report;
    report.name = "pipeline";
    report.title = "From the file to the first frame";
    report.text = fmt::format(
        "By Google Benchmark: wall milliseconds of every step, medians of the repetitions. Regions: outlines "
        "are "
        "lowered to the lattice; cells: divided; leaves: planarised, then fitted; records "
        "encoded; "
        "textures uploaded; the first frame drawn by shaders that are compiled, {} pixels long, on {}, {}.",
        options.side, gl->context.renderer(), gl->context.version());
    for (const File& file : filesOf(options))
        benchmark::RegisterBenchmark(
            ("pipeline/" + file.name).c_str(),
            [=](benchmark::State& state) { passThrough(state, file, options.side, *gl); })
            ->UseRealTime()
            ->Unit(benchmark::kMillisecond);
    for (const Measured& one :
         runRegistered(options.filter, {options.quick ? 5 : 9, options.quick ? 0.1 : 0.5})) {
        Json row = {{"file", one.name.substr(one.name.find('/') + 1)}};
        for (const char* step :
             {"parse", "lower", "divide", "planarise", "fit", "encode", "upload", "first frame"})
            row[step] = median(one.counters.at(step));
        row["all ms"] = median(one.milliseconds);
        row["quartiles"] =
            fmt::format("{:.3g}-{:.3g}", quantile(one.milliseconds, 0.25), quantile(one.milliseconds, 0.75));
        row["asset bytes"] = std::size_t(one.counters.at("bytes").front());
        row["pieces"] = std::size_t(one.counters.at("pieces").front());
        report.rows.push_back(std::move(row));
    }
    return report;
}

}  // namespace vtm::bench
