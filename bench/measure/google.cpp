#include "bench/measure/google.hpp"

#include <algorithm>

#include <benchmark/benchmark.h>
#include <fmt/core.h>

namespace vtm::bench {
namespace {

class Collector : public benchmark::BenchmarkReporter {
public:
    bool ReportContext(const Context&) override { return true; }

    void ReportRuns(const std::vector<Run>& runs) override {
        for (const Run& run : runs)
            if (run.run_type == Run::RT_Iteration && !run.error_occurred)
                add(run);
    }

    std::vector<Measured> all;

private:
    void add(const Run& run) {
        const std::string name = run.run_name.function_name;
        auto found = std::ranges::find(all, name, &Measured::name);
        if (found == all.end()) {
            fmt::print(stderr, "{}\n", name);
            found = all.insert(all.end(), {name, run.report_label, {}, {}});
        }
        found->milliseconds.push_back(run.GetAdjustedRealTime() * 1e3 /
                                      benchmark::GetTimeUnitMultiplier(run.time_unit));
        for (const auto& [counter, value] : run.counters)
            found->counters[counter].push_back(value.value);
    }
};

}  // namespace

std::vector<Measured> runRegistered(const std::string& filter, Effort effort) {
    std::vector<std::string> words{"vtm-bench", fmt::format("--benchmark_repetitions={}", effort.repetitions),
                                   fmt::format("--benchmark_min_time={}", effort.seconds)};
    std::vector<char*> arguments;
    for (std::string& word : words)
        arguments.push_back(word.data());
    auto count = int(arguments.size());
    benchmark::Initialize(&count, arguments.data());
    Collector collector;
    benchmark::RunSpecifiedBenchmarks(&collector, filter);
    benchmark::ClearRegisteredBenchmarks();
    return std::move(collector.all);
}

}  // namespace vtm::bench
