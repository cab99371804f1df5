#include <memory>

#include <fmt/core.h>

#include "asset/container.hpp"
#include "asset/prefilter.hpp"
#include "image/codec.hpp"
#include "tools/src/commands.hpp"
#include "tools/src/limits.hpp"
#include "tools/src/source.hpp"

namespace vtm::tools {

namespace {

struct CompileOptions {
    std::string input, output;
    SourceOptions source;
    bool prefilter = false, json = false;
};

int compile(const CompileOptions& options) {
    if (options.source.paper)
        throw UsageError("compile: a .vtm file holds no paper mode; see render and info --mode paper");
    const PictureLimits limits(options.input, true);
    try {
        Source source = loadSource(options.input, options.source);
        if (options.prefilter)
            source.asset->prefilter =
                timed(source.stages, "prefilter", [&] { return asset::buildPrefilter(*source.asset); });
        const std::size_t fileBytes = timed(source.stages, "write", [&] {
            const auto bytes = asset::write(*source.asset);
            image::writeFile(options.output, bytes);
            return bytes.size();
        });
        Json report = {{"input", options.input}, {"output", options.output}, {"file_bytes", fileBytes}};
        report.update(figures(*source.asset));
        report.update(source.proof);
        report["stages_ms"] = toJson(source.stages);
        if (options.json)
            fmt::print("{}\n", report.dump(2));
    } catch (...) {
        fmt::print(stderr, "{}\n", describeError(options.input));
        return badInput;
    }
    return done;
}

}  // namespace

void addCompile(CLI::App& app, int& exitCode) {
    const auto options = std::make_shared<CompileOptions>();
    CLI::App* command = app.add_subcommand("compile", "Make a .vtm file of an SVG file");
    command->add_option("IN", options->input, "SVG file")->required();
    command->add_option("-o,--output", options->output, "The .vtm file")->required();
    command->add_flag("--prefilter", options->prefilter,
                      "Add a pyramid of means for textures that are seen from afar");
    command->add_flag("--json", options->json, "Print figures and times");
    addSourceOptions(*command, options->source);
    command->callback([options, &exitCode] { exitCode = compile(*options); });
}

}  // namespace vtm::tools
