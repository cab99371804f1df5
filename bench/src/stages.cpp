// The compiler's stages on each file, by Google Benchmark: bench_stages --benchmark_filter=tiger.

#include <benchmark/benchmark.h>

#include "bench/src/files.hpp"
#include "compiler/compile.hpp"

namespace vtm::bench {
namespace {

/// Counters: milliseconds a stage and compilation, bytes and pieces of the asset.
void compileFile(benchmark::State& state, const File& file) {
    const scene::Scene scene = load(file);
    std::vector<compiler::StageTime> sums;
    asset::Summary summary;
    for (auto _ : state) {
        const compiler::Result result = compiler::compile(scene);
        sums.resize(result.stages.size());
        for (std::size_t i = 0; i < sums.size(); ++i) {
            sums[i].stage = result.stages[i].stage;
            sums[i].milliseconds += result.stages[i].milliseconds;
        }
        state.PauseTiming();
        summary = asset::summarize(result.asset);
        state.ResumeTiming();
    }
    for (const compiler::StageTime& sum : sums)
        state.counters[sum.stage] = benchmark::Counter(sum.milliseconds, benchmark::Counter::kAvgIterations);
    state.counters["bytes"] = double(summary.bytes);
    state.counters["pieces"] = double(summary.pieces);
}

void add(const std::string& group, const std::vector<File>& files) {
    for (const File& file : files)
        benchmark::RegisterBenchmark((group + "/" + file.name).c_str(),
                                     [file](benchmark::State& state) { compileFile(state, file); })
            ->Unit(benchmark::kMillisecond)
            ->MeasureProcessCPUTime()
            ->UseRealTime();
}

}  // namespace
}  // namespace vtm::bench

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv))
        return 2;
    vtm::bench::add("examples", vtm::bench::exampleFiles());
    vtm::bench::add("corpus", vtm::bench::corpusFiles());
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
