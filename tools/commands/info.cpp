#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <vtm/asset/container.hpp>
#include "tools/commands/commands.hpp"
#include "tools/commands/report.hpp"
#include "tools/options/options.hpp"
#include "tools/output/output.hpp"
#include "tools/process/errors.hpp"
#include "tools/process/limits.hpp"
#include "tools/process/messages.hpp"

namespace vtm::tools {

namespace {

struct InfoOptions {
    std::string input;
    SourceOptions source;
    bool json = false;
};

/// A file's section table; empty for what is no .vtm file. It is read before the asset, so that a
/// damaged file still shows which of its sections are whole.
std::vector<asset::SectionInfo> sectionsOf(const Input& input) {
    return input.isAsset() ? asset::sectionsOf(input.bytes) : std::vector<asset::SectionInfo>();
}

Json listOf(const std::vector<asset::SectionInfo>& sections) {
    Json list = Json::array();
    for (const asset::SectionInfo& section : sections)
        list.push_back({{"name", section.name},
                        {"offset", section.offset},
                        {"record_bytes", section.recordBytes},
                        {"count", section.count},
                        {"bytes", section.bytes()},
                        {"crc32", fmt::format("{:08x}", section.checksum)},
                        {"intact", section.intact()}});
    return list;
}

std::string textOf(const std::vector<asset::SectionInfo>& sections) {
    std::string text = fmt::format("{:<12}{:>10}{:>12}{:>14}{:>12}  checksum\n", "section", "offset", "bytes",
                                   "records", "bytes each");
    for (const asset::SectionInfo& section : sections)
        text += fmt::format("{:<12}{:>10}{:>12}{:>14}{:>12}  {:08x} {}\n", section.name, section.offset,
                            section.bytes(), section.count, section.recordBytes, section.checksum,
                            section.intact() ? "ok" : fmt::format("DAMAGED: is {:08x}", section.found));
    return text;
}

void printReport(Json report, const std::vector<asset::SectionInfo>& sections, bool json) {
    if (json && !sections.empty())
        report["sections"] = listOf(sections);
    print(json ? jsonText(report) : toText(report) + (sections.empty() ? "" : textOf(sections)));
}

const char* modeOf(const Source& source) {
    if (source.paper)
        return "paper";
    return source.asset->mode == asset::Mode::Exact ? "exact" : "compat";
}

int info(const InfoOptions& options) {
    Json report = {{"input", options.input}};
    std::vector<asset::SectionInfo> sections;
    const PictureLimits limits(nameOf(options.input), true);
    try {
        Input input = readInput(options.input);
        sections = sectionsOf(input);
        const Source source = loadSource(std::move(input), options.source);
        report["width"] = source.width;
        report["height"] = source.height;
        report["mode"] = modeOf(source);
        report.update(source.paper ? figures(*source.paper) : figures(*source.asset));
        if (source.asset)
            report["finest_pixel"] = source.asset->finestPixel ? Json(*source.asset->finestPixel) : Json();
        if (source.proof)
            report.update(figures(*source.proof));
        report["stages_ms"] = toJson(source.stages);
        printReport(report, sections, options.json);
    } catch (...) {
        if (!sections.empty())
            printReport(report, sections, options.json);
        say(describeError(nameOf(options.input)));
        return badInput;
    }
    return done;
}

}  // namespace

void addInfo(CLI::App& app, int& exitCode) {
    const auto options = std::make_shared<InfoOptions>();
    CLI::App* command = app.add_subcommand("info", "Show what a file contains (an SVG is compiled first)");
    command->add_option("FILE", options->input, "SVG, .vtmtree or .vtm file, or - for standard input")
        ->required();
    command->add_flag("--json", options->json, "Print the figures as JSON");
    addSourceOptions(*command, options->source);
    command->footer("Examples:\n  vtm info tiger.vtm\n  vtm info tiger.svg --json");
    command->callback([options, &exitCode] { exitCode = info(*options); });
}

}  // namespace vtm::tools
