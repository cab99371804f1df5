#include "trace/trace.hpp"

#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <vtm/asset/container.hpp>
#include <vtm/image/codec.hpp>
#include <vtm/svg/write.hpp>
#include "tools/commands/commands.hpp"
#include "tools/input/input.hpp"
#include "tools/options/options.hpp"
#include "tools/output/output.hpp"
#include "tools/process/errors.hpp"
#include "tools/process/limits.hpp"
#include "tools/process/messages.hpp"

namespace vtm::tools {

namespace {

struct TraceOptions {
    std::string input, output;
    trace::Options trace;
    compiler::Options compiler;
};

/// By its name; what has none of the suffixes is SVG.
bool isAsset(const std::string& output) { return suffixOf(output) == ".vtm"; }

std::vector<std::uint8_t> svgOf(const scene::Scene& scene) {
    const std::string text = svg::write(scene);
    return {text.begin(), text.end()};
}

std::vector<std::uint8_t> assetOf(const scene::Scene& scene, const TraceOptions& options) {
    const compiler::Result result = compiler::compile(scene, options.compiler);
    for (const std::string& warning : result.warnings)
        warn(fmt::format("{}: warning: {}", nameOf(options.input), warning));
    return asset::write(result.asset);
}

int run(const TraceOptions& options) {
    if (!trace::available())
        throw UsageError(
            "trace: potrace is missing: install it (libpotrace0), or, if this vtm was built without its "
            "header "
            "(libpotrace-dev), build again with -DVTM_WITH_POTRACE=ON");
    requireSuffix(options.output, {".svg", ".vtm"});
    refuseLoss({options.input}, {options.output});
    const PictureLimits limits(nameOf(options.input), true);
    try {
        const scene::Scene scene = trace::trace(image::decode(readInput(options.input).bytes), options.trace);
        writeOutput(options.output, isAsset(options.output) ? assetOf(scene, options) : svgOf(scene));
    } catch (...) {
        say(describeError(nameOf(options.input)));
        return badInput;
    }
    return done;
}

}  // namespace

void addTrace(CLI::App& app, int& exitCode) {
    const auto options = std::make_shared<TraceOptions>();
    CLI::App* command = app.add_subcommand("trace", "Turn a bitmap into an SVG or a .vtm file");
    command->add_option("IN", options->input, "PNG, JPEG, WebP, GIF or AVIF file, or - for standard input")
        ->required();
    command
        ->add_option("-o,--output", options->output, "The .svg or .vtm file, or - for SVG on standard output")
        ->required();
    command->add_option("--colors", options->trace.colors, "Max number of colours")
        ->check(CLI::Range(1, 256))
        ->capture_default_str();
    command->add_option("--speckle", options->trace.speckle, "Drop spots of up to this many pixels")
        ->check(CLI::Range(0, 1000000))
        ->capture_default_str();
    command
        ->add_option("--smooth", options->trace.smooth,
                     "Smoothness, from 0 (polygons) to 1.3334 (no corners)")
        ->check(CLI::Range(0.0, 1.3334))
        ->capture_default_str();
    command
        ->add_option("--tolerance", options->compiler.tolerance,
                     "Max error of boundaries in the .vtm file, as a share of its longer side")
        ->check(CLI::Range(0x1p-26, 0x1p-6));
    command->footer(
        "Examples:\n  vtm trace scan.png -o scan.svg --colors 4\n  vtm trace scan.png -o scan.vtm --speckle "
        "8");
    command->callback([options, &exitCode] { exitCode = run(*options); });
}

}  // namespace vtm::tools
