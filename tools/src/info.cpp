#include <filesystem>
#include <memory>

#include <fmt/core.h>

#include "asset/container.hpp"
#include "image/codec.hpp"
#include "tools/src/commands.hpp"
#include "tools/src/limits.hpp"
#include "tools/src/source.hpp"

namespace vtm::tools {

namespace {

struct InfoOptions {
    std::string input;
    SourceOptions source;
    bool json = false;
};

/// A file's section table; empty for what is no .vtm file. It is read before the asset, so that a
/// damaged file still shows which of its sections are whole.
std::vector<asset::SectionInfo> sectionsOf(const std::string& path) {
    if (std::filesystem::path(path).extension() != ".vtm")
        return {};
    return asset::sectionsOf(image::readFile(path));
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

void printSections(const std::vector<asset::SectionInfo>& sections) {
    fmt::print("{:<12}{:>10}{:>12}{:>14}{:>12}  checksum\n", "section", "offset", "bytes", "records",
               "bytes each");
    for (const asset::SectionInfo& section : sections)
        fmt::print("{:<12}{:>10}{:>12}{:>14}{:>12}  {:08x} {}\n", section.name, section.offset,
                   section.bytes(), section.count, section.recordBytes, section.checksum,
                   section.intact() ? "ok" : fmt::format("DAMAGED: is {:08x}", section.found));
}

void print(Json report, const std::vector<asset::SectionInfo>& sections, bool json) {
    if (json) {
        if (!sections.empty())
            report["sections"] = listOf(sections);
        fmt::print("{}\n", report.dump(2));
        return;
    }
    printText(report);
    if (!sections.empty())
        printSections(sections);
}

const char* modeOf(const Source& source) {
    if (source.paper)
        return "paper";
    return source.asset->mode == asset::Mode::Exact ? "exact" : "compat";
}

int info(const InfoOptions& options) {
    Json report = {{"input", options.input}};
    std::vector<asset::SectionInfo> sections;
    const PictureLimits limits(options.input, true);
    try {
        sections = sectionsOf(options.input);
        const Source source = loadSource(options.input, options.source);
        report["width"] = source.width;
        report["height"] = source.height;
        report["mode"] = modeOf(source);
        report.update(source.paper ? figures(*source.paper) : figures(*source.asset));
        report.update(source.proof);
        report["stages_ms"] = toJson(source.stages);
        print(report, sections, options.json);
    } catch (...) {
        if (!sections.empty())
            print(report, sections, options.json);
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
