#include <memory>

#include <fmt/core.h>

#include "tools/src/commands.hpp"
#include "tools/src/source.hpp"

namespace vtm::tools {

namespace {

struct InfoOptions {
    std::string input;
    SourceOptions source;
    bool json = false;
};

const char* modeOf(const Source& source) {
    if (source.paper)
        return "paper";
    return source.asset->mode == asset::Mode::Exact ? "exact" : "compat";
}

int info(const InfoOptions& options) {
    try {
        const Source source = loadSource(options.input, options.source);
        Json report = {{"input", options.input},
                       {"width", source.width},
                       {"height", source.height},
                       {"mode", modeOf(source)}};
        report.update(source.paper ? figures(*source.paper) : figures(*source.asset));
        report["stages_ms"] = toJson(source.stages);
        if (options.json)
            fmt::print("{}\n", report.dump(2));
        else
            printText(report);
    } catch (...) {
        fmt::print(stderr, "{}\n", describeError(options.input));
        return badInput;
    }
    return done;
}

}  // namespace

void addInfo(CLI::App& app, int& exitCode) {
    const auto options = std::make_shared<InfoOptions>();
    CLI::App* command =
        app.add_subcommand("info", "Say what a file holds, compiled (an SVG is compiled first)");
    command->add_option("FILE", options->input, "SVG or .vtm file")->required();
    command->add_flag("--json", options->json, "As JSON");
    addSourceOptions(*command, options->source);
    command->callback([options, &exitCode] { exitCode = info(*options); });
}

}  // namespace vtm::tools
