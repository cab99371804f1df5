#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>

#include <fmt/core.h>

#include "image/codec.hpp"
#include "tools/src/color.hpp"
#include "tools/src/commands.hpp"
#include "tools/src/debug_view.hpp"
#include "tools/src/engine.hpp"
#include "tools/src/framing.hpp"
#include "tools/src/limits.hpp"
#include "tools/src/progress.hpp"
#include "tools/src/source.hpp"

namespace vtm::tools {

namespace {

namespace fs = std::filesystem;

struct RenderOptions {
    std::vector<std::string> inputs;
    std::string output, batch;
    std::string engine = "gl", background = "transparent", programCache, debugView;
    SourceOptions source;
    Framing framing;
    bool json = false;
};

struct Job {
    std::string input, output;
};

/// Lines IN<TAB>OUT; empty ones do not count.
std::vector<Job> readBatch(const std::string& path) {
    std::ifstream file(path);
    if (!file)
        throw std::runtime_error(path + ": cannot be read");
    std::vector<Job> jobs;
    std::string line;
    for (int number = 1; std::getline(file, line); ++number) {
        if (line.empty())
            continue;
        const std::size_t tab = line.find('\t');
        if (tab == std::string::npos || tab == 0 || tab + 1 == line.size())
            throw std::runtime_error(fmt::format("{}:{}:1: wants IN<TAB>OUT", path, number));
        jobs.push_back({line.substr(0, tab), line.substr(tab + 1)});
    }
    return jobs;
}

bool meansDirectory(const std::string& output) { return output.ends_with('/') || fs::is_directory(output); }

std::vector<Job> jobsOf(const RenderOptions& options) {
    if (!options.batch.empty())
        return readBatch(options.batch);
    if (options.inputs.empty() || options.output.empty())
        throw UsageError("render: wants IN... and -o OUT, or --batch LIST");
    const bool directory = meansDirectory(options.output);
    if (!directory && options.inputs.size() > 1 && fs::path(options.output).has_extension())
        throw UsageError("-o: many inputs want a directory, not " + options.output);
    if (!directory && options.inputs.size() == 1)
        return {{options.inputs[0], options.output}};
    std::vector<Job> jobs;
    for (const std::string& input : options.inputs)
        jobs.push_back({input, (fs::path(options.output) / fs::path(input).stem()).string() + ".png"});
    return jobs;
}

void refuseClashes(const std::vector<Job>& jobs) {
    std::set<std::string> outputs;
    for (const Job& job : jobs) {
        if (!outputs.insert(job.output).second)
            throw UsageError(job.output + ": more than one input would be written there");
    }
}

bool writePng(const image::Bitmap& bitmap, const std::string& path) {
    const fs::path directory = fs::path(path).parent_path();
    if (!directory.empty())
        fs::create_directories(directory);
    image::writeFile(path, image::encodePng(bitmap));
    return true;
}

void printReport(const Job& job, const Source& source, const asset::View& view) {
    Json report = {
        {"input", job.input}, {"output", job.output}, {"width", view.width}, {"height", view.height}};
    if (source.asset)
        report.update(figures(*source.asset));
    if (source.paper)
        report.update(figures(*source.paper));
    if (source.cost)
        report["lookups"] = perPixel(*source.cost, std::uint64_t(view.width) * std::uint64_t(view.height));
    report["stages_ms"] = toJson(source.stages);
    fmt::print("{}\n", report.dump());
}

/// What a raster still does not show, a sixteenth of a pixel, as a share of the picture's longer side.
double hiddenTolerance(const asset::View& view, double width, double height) {
    constexpr double pixels = 1.0 / 16;
    const auto& m = view.toPixels;
    const double scale = std::max(std::hypot(m[0].x, m[0].y), std::hypot(m[1].x, m[1].y));
    return pixels / (scale * std::max(width, height));
}

void renderOne(const Job& job, const RenderOptions& options, const scene::Color& ground, Engine& engine) {
    SourceOptions loading = options.source;
    loading.coarserTolerance = [&](double width, double height) {
        return hiddenTolerance(frame(options.framing, width, height), width, height);
    };
    Source source = loadSource(job.input, loading, engine.needsAsset());
    const asset::View view = frame(options.framing, source.width, source.height);
    const DebugView debug = parseDebugView(options.debugView);
    prepare(source, debug);
    image::Bitmap bitmap = engine.draw(source, view, ground);
    layLines(bitmap, debug, source, view);
    timed(source.stages, "write", [&] { return writePng(bitmap, job.output); });
    if (options.json)
        printReport(job, source, view);
}

bool succeeds(const Job& job, const RenderOptions& options, const scene::Color& ground, Engine& engine,
              bool alone) {
    const PictureLimits limits(job.input, alone);
    try {
        renderOne(job, options, ground, engine);
        return true;
    } catch (...) {
        printWarning(describeError(job.input));
        return false;
    }
}

int render(const RenderOptions& options) {
    parseDebugView(options.debugView);
    const auto engine = makeEngine(options.engine, options.source.compiler.mode, options.programCache);
    const scene::Color ground = parseColor(options.background);
    const std::vector<Job> jobs = jobsOf(options);
    refuseClashes(jobs);
    std::size_t failed = 0;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        showProgress(i, jobs.size());
        failed += succeeds(jobs[i], options, ground, *engine, jobs.size() == 1) ? 0 : 1;
    }
    clearProgress();
    if (jobs.size() > 1 || !options.batch.empty())
        fmt::print(stderr, "{} of {} drawn, {} failed\n", jobs.size() - failed, jobs.size(), failed);
    return failed == 0 ? done : badInput;
}

}  // namespace

void addRender(CLI::App& app, int& exitCode) {
    const auto options = std::make_shared<RenderOptions>();
    CLI::App* command = app.add_subcommand("render", "Draw SVG or .vtm files as PNG");
    auto* inputs = command->add_option("IN", options->inputs, "SVG or .vtm files");
    auto* output = command->add_option("-o,--output", options->output, "PNG file, or a directory");
    command->add_option("--batch", options->batch, "A file of lines IN<TAB>OUT")
        ->excludes(inputs)
        ->excludes(output);
    addFramingOptions(*command, options->framing);
    command->add_option("--background", options->background, "The ground's colour")->capture_default_str();
    command
        ->add_option("--engine", options->engine,
                     "gl, cpu (fast without a GPU, exact mode), asset (the shaders' twin, slow) or reference "
                     "(exact, slower)")
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
