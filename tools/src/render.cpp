#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include <vtm/image/codec.hpp>
#include "tools/src/color.hpp"
#include "tools/src/commands.hpp"
#include "tools/src/debug_view.hpp"
#include "tools/src/engine.hpp"
#include "tools/src/framing.hpp"
#include "tools/src/jobs.hpp"
#include "tools/src/left_out.hpp"
#include "tools/src/limits.hpp"
#include "tools/src/output.hpp"
#include "tools/src/progress.hpp"
#include "tools/src/source.hpp"
#include "tools/src/standard_output.hpp"
#include "tools/src/zoom.hpp"

namespace vtm::tools {

namespace {

namespace fs = std::filesystem;

struct RenderOptions {
    std::vector<std::string> inputs;
    std::string output, batch;
    std::string engine = "auto", background = "transparent", programCache, debugView;
    SourceOptions source;
    scene::Framing framing;
    bool json = false;
};

/// Into a folder that may have to be made.
bool writePng(const image::Bitmap& bitmap, const std::string& output) {
    const fs::path directory = fs::path(output).parent_path();
    if (!directory.empty())
        fs::create_directories(directory);
    writeOutput(output, image::encodePng(bitmap));
    return true;
}

void printReport(const Job& job, const Source& source, const asset::View& view, const Engine& engine) {
    Json report = {{"input", job.input},
                   {"output", job.output},
                   {"width", view.width},
                   {"height", view.height},
                   {"engine", engine.name()}};
    if (source.asset)
        report.update(figures(*source.asset));
    if (source.paper)
        report.update(figures(*source.paper));
    if (source.cost)
        report["lookups"] = perPixel(*source.cost, std::uint64_t(view.width) * std::uint64_t(view.height));
    report["stages_ms"] = toJson(source.stages);
    print(jsonLine(report));
}

void renderOne(const Job& job, const RenderOptions& options, const scene::Color& ground, Engine& engine) {
    Source source = loadSource(readInput(job.input), options.source, false);
    const asset::View view = prepareView(source, options.source, options.framing, engine.needsAsset());
    const DebugView debug = parseDebugView(options.debugView);
    prepare(source, debug);
    image::Bitmap bitmap = engine.draw(source, view, ground);
    layLines(bitmap, debug, source, view);
    if (options.source.strict)
        refuseLeftOut(source);
    timed(source.stages, "write", [&] { return writePng(bitmap, job.output); });
    if (options.json)
        printReport(job, source, view, engine);
}

bool succeeds(const Job& job, const RenderOptions& options, const scene::Color& ground, Engine& engine,
              bool alone) {
    const PictureLimits limits(nameOf(job.input), alone);
    try {
        renderOne(job, options, ground, engine);
        return true;
    } catch (...) {
        say(describeError(nameOf(job.input)));
        return false;
    }
}

std::vector<Job> checkedJobs(const RenderOptions& options) {
    const std::vector<Job> jobs =
        options.batch.empty() ? jobsOf(options.inputs, options.output) : readBatch(options.batch);
    if (options.json)
        for (const Job& job : jobs)
            refuseMixture(job.output, "the figures of --json");
    refuseLoss(jobs, options.batch);
    return jobs;
}

int render(const RenderOptions& options) {
    if (parseDebugView(options.debugView) != DebugView::None && options.framing.rotation != 0)
        throw UsageError("--debug-view: shows pictures that are not turned");
    const auto engine = makeEngine(options.engine, options.source.compiler.mode, options.programCache);
    const scene::Color ground = parseColor(options.background);
    const std::vector<Job> jobs = checkedJobs(options);
    std::size_t failed = 0;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        showProgress(i, jobs.size());
        failed += succeeds(jobs[i], options, ground, *engine, jobs.size() == 1) ? 0 : 1;
    }
    clearProgress();
    if (jobs.size() > 1 || !options.batch.empty())
        say(fmt::format("{} of {} drawn, {} failed", jobs.size() - failed, jobs.size(), failed));
    return failed == 0 ? done : badInput;
}

}  // namespace

void addRender(CLI::App& app, int& exitCode) {
    const auto options = std::make_shared<RenderOptions>();
    CLI::App* command = app.add_subcommand("render", "Draw SVG or .vtm files as PNG");
    auto* inputs = command->add_option("IN", options->inputs, "SVG or .vtm files, or - for standard input");
    auto* output = command->add_option("-o,--output", options->output,
                                       "PNG file, a directory, or - for standard output");
    command->add_option("--batch", options->batch, "A file of lines IN<TAB>OUT, or - for standard input")
        ->excludes(inputs)
        ->excludes(output);
    addFramingOptions(*command, options->framing);
    command->add_option("--background", options->background, "The ground's colour")->capture_default_str();
    command
        ->add_option("--engine", options->engine,
                     "auto (gl where there is a GPU, else cpu for all that it can draw), gl (shaders), cpu "
                     "(fast without "
                     "a GPU, exact mode), asset (the shaders' twin, slow) or reference (exact, slower)")
        ->capture_default_str();
    command->add_option("--program-cache", options->programCache,
                        "A directory that keeps the GL driver's programs from run to run");
    command->add_option(
        "--debug-view", options->debugView,
        "Shows how the picture is stored: cells, depth, pieces, cost, regions, fallback, patches");
    command->add_flag("--json", options->json, "Print figures and times, a line of JSON a picture");
    addSourceOptions(*command, options->source);
    command->callback([options, &exitCode] { exitCode = render(*options); });
}

}  // namespace vtm::tools
