// Single steps by Google Benchmark. The compiler's are timed by its own clock (Result::stages), since its
// stages are no one else's to call; a scene of known numbers makes them nanoseconds a curve or a piece.

#include <memory>

#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <vtm/compiler/compile.hpp>
#include <vtm/compiler/stroke.hpp>
#include <vtm/raster/evaluate.hpp>
#include <vtm/raster/scan.hpp>
#include "bench/input/files.hpp"
#include "bench/input/synthetic.hpp"
#include "bench/measure/google.hpp"
#include "bench/measure/measure.hpp"
#include "bench/reports/reports.hpp"
#include "raster/coverage.hpp"

namespace vtm::bench {
namespace {

constexpr std::size_t curves = 10'000;
constexpr int viewSide = 512;  ///< pixels of the views

/// One scene and its asset, for all.
struct Subject {
    scene::Scene scene = syntheticScene(curves);
    asset::Asset asset = compiler::compile(scene).asset;

    /// The whole scene is the unit square.
    asset::View view = {viewSide, viewSide, {double(viewSide), 0, 0, double(viewSide), 0, 0}};
};
using Shared = std::shared_ptr<const Subject>;

template <class Work>
benchmark::internal::Benchmark* add(const std::string& name, Work&& work) {
    return benchmark::RegisterBenchmark(("micro/" + name).c_str(), std::forward<Work>(work))
        ->Unit(benchmark::kMillisecond);
}

/// Each iteration does `items` of what the label names.
void itemsOf(benchmark::State& state, const std::string& item, double items) {
    state.SetLabel(item);
    state.counters["items"] = items;
}

/// A stage of the compiler by its own clock, wall time of all threads.
void addStage(const Shared& subject, const std::string& stage, const std::string& name,
              const std::string& item, double items) {
    add(name, [=](benchmark::State& state) {
        for (auto _ : state)
            for (const compiler::StageTime& time : compiler::compile(subject->scene).stages)
                if (time.stage == stage)
                    state.SetIterationTime(time.milliseconds / 1e3);
        itemsOf(state, item, items);
    })->UseManualTime();
}

void addCompiler(const Shared& subject) {
    const auto pieces = double(subject->asset.pieces.size());
    addStage(subject, "lower", "flatten and quantise", "curve", curves);
    addStage(subject, "divide", "divide into cells", "curve", curves);
    addStage(subject, "planarise", "planarise leaves", "piece", pieces);
    addStage(subject, "fit", "fit pieces", "piece", pieces);
    addStage(subject, "encode", "encode records", "piece", pieces);
    add("outline of strokes", [subject](benchmark::State& state) {
        const scene::StrokeStyle style{.width = 0.002, .dashes = {}};
        for (auto _ : state)
            for (const scene::Node& node : subject->scene.root.children)
                benchmark::DoNotOptimize(
                    compiler::strokeOutline(*std::get<scene::Item>(node.value).path, style, 1.0 / 65536));
        itemsOf(state, "curve", curves);
    });
}

void addCoverage(const Shared& subject) {
    add("coverage of a chord", [](benchmark::State& state) {
        constexpr int chords = 1024;
        float sum = 0;
        for (auto _ : state)
            for (int i = 0; i < chords; ++i) {
                const float t = float(i) / chords;
                sum += asset::seg({t, 1 - 2 * t}, {1.5f * t - 0.25f, t});
                benchmark::DoNotOptimize(sum);
            }
        itemsOf(state, "chord", chords);
    });
    add("coverage of a piece", [subject](benchmark::State& state) {
        // A pixel in the middle of a leaf that is 16 pixels wide.
        const asset::LeafFrame frame{glm::mat2(16.0f / 65535), {-7.5f, -7.5f}};
        const asset::Corners corners = asset::cornersOf(frame);
        float sum = 0;
        for (auto _ : state)
            for (const asset::Piece& piece : subject->asset.pieces) {
                sum += asset::pieceSum(frame, corners, piece);
                benchmark::DoNotOptimize(sum);
            }
        itemsOf(state, "piece", double(subject->asset.pieces.size()));
    });
    add("CPU evaluator", [subject](benchmark::State& state) {
        for (auto _ : state)
            benchmark::DoNotOptimize(asset::evaluate(subject->asset, subject->view));
        itemsOf(state, "pixel", double(viewSide) * viewSide);
    });
    add("scanner", [subject](benchmark::State& state) {
        const asset::Scanner scanner(subject->asset);
        std::vector<std::uint8_t> bytes(std::size_t(viewSide) * viewSide * 4);
        for (auto _ : state)
            scanner.draw(subject->view, {bytes.data(), std::size_t(viewSide) * 4});
        itemsOf(state, "pixel", double(viewSide) * viewSide);
    });
    add("scanner of coverage alone", [subject](benchmark::State& state) {
        const asset::CoverageScanner scanner(subject->asset);
        for (auto _ : state)
            scanner.scan(subject->view, [](int, std::span<const asset::CoverageRun> runs) {
                benchmark::DoNotOptimize(runs.data());
            });
        itemsOf(state, "pixel", double(viewSide) * viewSide);
    });
}

}  // namespace

Report micro(const Options& options) {
    Report report;
    report.name = "micro";
    report.title = "Single steps";
    report.text = fmt::format(
        "By Google Benchmark on a scene of {} cubics (`scaling` says which): wall time of one item, median "
        "and "
        "quartiles of the repetitions. The compiler's stages by its own clock; pixels of a view of {} × {} "
        "that shows all of it.",
        curves, viewSide, viewSide);
    const auto subject = std::make_shared<const Subject>();
    addCompiler(subject);
    addCoverage(subject);
    const int repetitions = options.quick ? 5 : 15;
    for (const Measured& one : runRegistered(options.filter, {repetitions, options.quick ? 0.05 : 0.2})) {
        std::vector<double> each;
        const double items = one.counters.at("items").front();
        for (const double milliseconds : one.milliseconds)
            each.push_back(milliseconds * 1e6 / items);
        report.rows.push_back({{"step", one.name.substr(one.name.find('/') + 1)},
                               {"item", one.label},
                               {"ns", median(each)},
                               {"low", quantile(each, 0.25)},
                               {"high", quantile(each, 0.75)},
                               {"items a run", items}});
    }
    return report;
}

}  // namespace vtm::bench
