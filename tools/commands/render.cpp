#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <vtm/image/codec.hpp>
#include "tools/commands/commands.hpp"
#include "tools/commands/report.hpp"
#include "tools/engines/debug_view.hpp"
#include "tools/engines/engine.hpp"
#include "tools/input/input.hpp"
#include "tools/input/view.hpp"
#include "tools/options/options.hpp"
#include "tools/output/output.hpp"
#include "tools/output/picture_file.hpp"
#include "tools/process/errors.hpp"
#include "tools/process/limits.hpp"
#include "tools/process/messages.hpp"

namespace vtm::tools {

namespace {

struct Job {
    std::string input, output;
};

namespace fs = std::filesystem;

bool meansDirectory(const std::string& output) { return output.ends_with('/') || fs::is_directory(output); }

/// The picture's file in a directory.
std::string fileFor(const std::string& input, const std::string& directory, const std::string& suffix) {
    const std::string stem = input == standardStream ? "stdin" : fs::path(input).stem().string();
    return (fs::path(directory) / stem).string() + suffix;
}

/// Lines IN<TAB>OUT of a file, or of standard input for "-"; empty ones do not count. Throws
/// std::runtime_error.
std::vector<Job> readBatch(const std::string& path) {
    const Input list = readInput(path);
    std::istringstream text(std::string(list.bytes.begin(), list.bytes.end()));
    std::vector<Job> jobs;
    std::string line;
    for (int number = 1; std::getline(text, line); ++number) {
        if (line.empty())
            continue;
        const std::size_t tab = line.find('\t');
        if (tab == std::string::npos || tab == 0 || tab + 1 == line.size())
            throw std::runtime_error(fmt::format("{}:{}:1: expected IN<TAB>OUT", list.name, number));
        jobs.push_back({line.substr(0, tab), line.substr(tab + 1)});
    }
    return jobs;
}

/// Into one file, or into a directory: one that exists, that ends in '/', or that many inputs go to; pictures
/// in it are called as their inputs, with `suffix`. Throws UsageError.
std::vector<Job> jobsOf(const std::vector<std::string>& inputs, const std::string& output,
                        const std::string& suffix) {
    if (inputs.empty() || output.empty())
        throw UsageError("render: needs IN... and -o OUT, or --batch LIST");
    const bool directory = meansDirectory(output);
    if (!directory && inputs.size() == 1)
        return {{inputs[0], output}};
    if (!directory && (fs::path(output).has_extension() || isStandardOutput(output)))
        throw UsageError("-o: several inputs need a directory, not " + output);
    std::vector<Job> jobs;
    for (const std::string& input : inputs)
        jobs.push_back({input, fileFor(input, output, suffix)});
    return jobs;
}

/// Throws UsageError where a job would overwrite what another one writes or any reads.
/// `batch`: the list that they came from, if any.
void refuseOverwrites(const std::vector<Job>& jobs, const std::string& batch) {
    std::vector<std::string> inputs, outputs;
    if (!batch.empty())
        inputs.push_back(batch);
    for (const Job& job : jobs) {
        inputs.push_back(job.input);
        outputs.push_back(job.output);
    }
    refuseLoss(inputs, outputs);
}

constexpr const char* examples =
    "Examples:\n"
    "  vtm render tiger.svg -o tiger.png -w 800\n"
    "  vtm render tiger.svg -o tiger.jpg -w 800 -h 600 --fit cover -b white\n"
    "  vtm render tiger.svg -o nose.png --view 150,200,100,100 --zoom 8\n"
    "  vtm render icons/*.svg -o png/ -z 2\n"
    "  vtm render - -o - < in.svg > out.png";

struct RenderOptions {
    std::vector<std::string> inputs;
    std::string output, batch;
    std::string engine = "auto", background = "transparent", programCache, debugView;
    SourceOptions source;
    scene::Framing framing;
    FileOptions file;
    bool json = false, verbose = false;
};

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

/// For files that have no alpha.
scene::Color overWhite(const scene::Color& color) {
    const auto channel = [&](float c) { return c * color.a + (1 - color.a); };
    return {channel(color.r), channel(color.g), channel(color.b), 1};
}

image::PixelWriter writerFor(const Job& job, const RenderOptions& options, const scene::Color& ground) {
    const bool isOpaque = !image::hasAlpha(formatOf(job.output, options.file));
    const scene::Color under = isOpaque ? overWhite(ground) : ground;
    return image::PixelWriter({under.r, under.g, under.b, under.a}, options.file.encoding.depth);
}

/// Grown to whole pixels at this scale, as rsvg-convert does: nothing is squeezed or cut off.
scene::Rect toWholePixels(const scene::Rect& part, double scale) {
    constexpr double unseen = 1.0 / 512;  // of a pixel: such coverage is 0 in 8 bits
    const auto side = [&](double length) {
        return std::max(1.0, std::ceil(length * scale - unseen)) / scale;
    };
    return {part.x, part.y, side(part.width), side(part.height)};
}

/// What --export-id draws is what is seen of it, where no --view says otherwise.
scene::Framing framingOf(const RenderOptions& options, const Source& source) {
    scene::Framing framing = options.framing;
    const bool hasSize = framing.width || framing.height;
    if (!framing.part && source.exported)
        framing.part = hasSize ? *source.exported : toWholePixels(*source.exported, framing.scale);
    return framing;
}

void drawDebugView(const DebugView debug, Source& source, const asset::View& view,
                   const image::PixelWriter& writer, Engine& engine, PictureFile& file) {
    image::Bitmap bitmap = drawBitmap(engine, source, view, writer);
    layLines(bitmap, debug, source, view);
    image::giveRows(bitmap, image::PixelWriter(), file.sink());
}

/// --json reports figures of assets, and debug views show them.
Preparation preparationFor(Source& source, const RenderOptions& options, Engine& engine, DebugView debug) {
    if (!engine.needsAsset())
        return Preparation::None;
    const bool isExact = !options.source.paper && options.source.compiler.mode == asset::Mode::Exact;
    const bool once = isExact && source.scene && !options.json && debug == DebugView::None;
    return once && engine.drawsOnce(source) ? Preparation::Drawing : Preparation::Asset;
}

void renderOne(const Job& job, const RenderOptions& options, const scene::Color& ground, Engine& engine) {
    Source source = loadSource(readInput(job.input), options.source, false);
    const DebugView debug = parseDebugView(options.debugView);
    const asset::View view = prepareView(source, options.source, framingOf(options, source),
                                         preparationFor(source, options, engine, debug));
    prepare(source, debug);
    const image::PixelWriter writer = writerFor(job, options, ground);
    PictureFile file(job.output, options.file, view.width, view.height);
    if (debug == DebugView::None)
        engine.draw(source, view, writer, file.sink());
    else
        drawDebugView(debug, source, view, writer, engine, file);
    if (options.source.strict)
        refuseLeftOut(source);
    file.write();
    source.stages.emplace_back("write", file.milliseconds());
    if (options.verbose)
        say(fmt::format("{}: {} x {} pixels, drawn by {}", source.name, readable(view.width),
                        readable(view.height), engine.name()));
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
    const std::vector<Job> jobs = options.batch.empty()
                                      ? jobsOf(options.inputs, options.output, suffixFor(options.file))
                                      : readBatch(options.batch);
    for (const Job& job : jobs) {
        formatOf(job.output, options.file);
        if (options.json)
            refuseMixture(job.output, "the figures of --json");
    }
    refuseOverwrites(jobs, options.batch);
    return jobs;
}

int render(const RenderOptions& options) {
    if (parseDebugView(options.debugView) != DebugView::None && options.framing.rotation != 0)
        throw UsageError("--debug-view: cannot be combined with --rotate");
    if (!options.debugView.empty() && options.file.encoding.depth != 8)
        throw UsageError("--debug-view: needs 8 bits per channel");
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
        warn(fmt::format("{} of {} drawn, {} failed", readable(double(jobs.size() - failed)),
                         readable(double(jobs.size())), readable(double(failed))));
    return failed == 0 ? done : badInput;
}

}  // namespace

void addRender(CLI::App& app, int& exitCode) {
    const auto options = std::make_shared<RenderOptions>();
    CLI::App* command =
        app.add_subcommand("render", "Draw SVG, .vtmtree or .vtm files as PNG, JPEG, WebP or PPM");
    auto* inputs =
        command->add_option("IN", options->inputs, "SVG, .vtmtree or .vtm files, or - for standard input");
    auto* output =
        command->add_option("-o,--output", options->output,
                            ".png, .jpg, .webp or .ppm file, a directory, or - for standard output");
    command
        ->add_option("--batch", options->batch,
                     "File with a line IN<TAB>OUT for each picture, or - for standard input")
        ->excludes(inputs)
        ->excludes(output);
    addFramingOptions(*command, options->framing);
    addFileOptions(*command, options->file);
    command
        ->add_option("-b,--background,--background-color", options->background,
                     "Any SVG colour; JPEG and PPM files have it over white")
        ->capture_default_str();
    command
        ->add_option("--engine", options->engine,
                     "auto (gl where there is a GPU, else cpu for all that it can draw), gl (shaders), cpu "
                     "(fast without "
                     "a GPU, exact mode), asset (the shaders' twin, slow) or reference (exact, slower)")
        ->capture_default_str();
    command->add_option("--program-cache", options->programCache,
                        "Directory that keeps the GL driver's compiled programs between runs");
    command->add_option(
        "--debug-view", options->debugView,
        "Show how the picture is stored: cells, depth, pieces, cost, regions, fallback, tiles");
    command->add_flag("--json", options->json, "Print figures and times as JSON, one line per picture");
    command->add_flag("-v,--verbose", options->verbose, "Print which engine drew each picture");
    addSourceOptions(*command, options->source);
    addExportId(*command, options->source.svg.exportId,
                "Draw only the element with this id; without --view it fills the raster");
    command->footer(examples);
    command->callback([options, &exitCode] { exitCode = render(*options); });
}

}  // namespace vtm::tools
