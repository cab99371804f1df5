#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <vtm/asset/container.hpp>
#include <vtm/raster/prefilter.hpp>
#include "tools/commands/commands.hpp"
#include "tools/commands/report.hpp"
#include "tools/input/input.hpp"
#include "tools/input/source.hpp"
#include "tools/options/options.hpp"
#include "tools/output/output.hpp"
#include "tools/process/errors.hpp"
#include "tools/process/limits.hpp"
#include "tools/process/messages.hpp"

namespace vtm::tools {

namespace {

struct CompileOptions {
    std::string input, output;
    SourceOptions source;
    bool prefilter = false, json = false;
};

int compile(const CompileOptions& options) {
    if (options.source.paper)
        throw UsageError(
            "compile: paper mode cannot be written to a .vtm file; see render and info --mode paper");
    requireSuffix(options.output, {".vtm"});
    if (options.json)
        refuseMixture(options.output, "the figures of --json");
    refuseLoss({options.input}, {options.output});
    const PictureLimits limits(nameOf(options.input), true);
    try {
        Source source = loadSource(readInput(options.input), options.source);
        if (options.prefilter)
            source.asset->prefilter =
                timed(source.stages, "prefilter", [&] { return asset::buildPrefilter(*source.asset); });
        const std::size_t fileBytes = timed(source.stages, "write", [&] {
            const auto bytes = asset::write(*source.asset);
            writeOutput(options.output, bytes);
            return bytes.size();
        });
        Json report = {{"input", options.input}, {"output", options.output}, {"file_bytes", fileBytes}};
        report.update(figures(*source.asset));
        if (source.proof)
            report.update(figures(*source.proof));
        report["stages_ms"] = toJson(source.stages);
        if (options.json)
            print(jsonText(report));
    } catch (...) {
        say(describeError(nameOf(options.input)));
        return badInput;
    }
    return done;
}

}  // namespace

void addCompile(CLI::App& app, int& exitCode) {
    const auto options = std::make_shared<CompileOptions>();
    CLI::App* command = app.add_subcommand("compile", "Make a .vtm file of an SVG or .vtmtree file");
    command->add_option("IN", options->input, "SVG or .vtmtree file, or - for standard input")->required();
    command->add_option("-o,--output", options->output, "The .vtm file, or - for standard output")
        ->required();
    command->add_flag("--prefilter", options->prefilter,
                      "Add a pyramid of mean colours, for use as a texture seen from afar");
    command->add_flag("--json", options->json, "Print figures and times as JSON");
    addSourceOptions(*command, options->source);
    command->footer(
        "Examples:\n  vtm compile tiger.svg -o tiger.vtm\n  vtm compile tiger.svg -o tiger.vtm --prefilter\n"
        "  vtm compile sign.vtmtree -o sign.vtm");
    command->callback([options, &exitCode] { exitCode = compile(*options); });
}

}  // namespace vtm::tools
