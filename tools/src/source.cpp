#include "tools/src/source.hpp"

#include <cmath>
#include <map>

#include <fmt/core.h>

#include <vtm/asset/container.hpp>
#include "tools/src/commands.hpp"
#include "tools/src/left_out.hpp"
#include "tools/src/text_options.hpp"

namespace vtm::tools {

namespace {

const std::map<std::string, asset::Mode> modes{{"exact", asset::Mode::Exact},
                                               {"compat", asset::Mode::Compat}};

void chooseMode(SourceOptions& options, const std::string& name) {
    options.paper = name == "paper";
    if (options.paper)
        return;
    const auto mode = modes.find(name);
    if (mode == modes.end())
        throw UsageError(fmt::format("--mode: '{}' is none of exact, compat, paper", name));
    options.mode = mode->second;
    options.compiler.mode = mode->second;
}

void loadAsset(Source& source, const Input& input, const SourceOptions& options) {
    if (options.paper)
        throw std::runtime_error("is compiled; paper mode draws SVG files only");
    if (!options.svg.exportId.empty() || !options.styleSheet.empty())
        throw std::runtime_error("is compiled; --export-id and --stylesheet want an SVG file");
    source.asset = timed(source.stages, "parse", [&] { return asset::read(input.bytes); });
    if (options.mode && *options.mode != source.asset->mode)
        throw std::runtime_error("was compiled in the other mode than --mode asks for");
    source.width = source.asset->width;
    source.height = source.asset->height;
}

std::string readStyleSheet(const std::string& path) {
    const Input sheet = readInput(path);
    return {sheet.bytes.begin(), sheet.bytes.end()};
}

void parseSvg(Source& source, const Input& input, const SourceOptions& given) {
    svg::Options options = given.svg;
    if (!given.styleSheet.empty())
        options.styleSheet = readStyleSheet(given.styleSheet);
    options.fileName = input.name;
    options.resourceDirectory = input.folder;
    svg::Document document = timed(source.stages, "parse", [&] { return svg::load(input.bytes, options); });
    warnOf(source, document.warnings);
    source.width = document.scene.width;
    source.height = document.scene.height;
    source.exported = document.exported;
    source.scene = std::move(document.scene);
}

void compilePaper(Source& source, const compiler::Options& options) {
    paper::CompileOptions paper;
    paper.tolerance = options.tolerance;
    paper::CompileResult result =
        timed(source.stages, "compile", [&] { return paper::compile(*source.scene, paper); });
    for (const std::string& warning : result.warnings)
        warnOf(source, fmt::format("{}: warning: {}", source.name, warning));
    source.paper = std::move(result);
}

void compileScene(Source& source, const compiler::Options& options) {
    compiler::Result result =
        timed(source.stages, "compile", [&] { return compiler::compile(*source.scene, options); });
    take(source, std::move(result));
}

}  // namespace

void addSourceOptions(CLI::App& command, SourceOptions& options) {
    command.add_option_function<std::string>(
        "--mode", [&options](const std::string& name) { chooseMode(options, name); },
        "exact: no seams (default); compat: layer by layer, as other renderers do; paper: as published in "
        "2005, to compare with");
    // The compiler's own range (compiler::Options::tolerance).
    command
        .add_option(
            "--tolerance", options.compiler.tolerance,
            "How far a boundary may be off, as a share of the longer side; render chooses one that fits "
            "the view unless it is given")
        ->each([&options](const std::string&) { options.hasTolerance = true; })
        ->check(CLI::Range(std::ldexp(1.0, -26), std::ldexp(1.0, -6)))
        ->capture_default_str();
    command.add_option("--dpi", options.svg.dpi, "Pixels an inch")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command.add_flag("--strict", options.strict,
                     "What is left out or repaired is an error: exit code 1, and nothing is written");
    command.add_option("-s,--stylesheet", options.styleSheet,
                       "A CSS file that comes before the style sheets of the SVG");
    for (const auto& [name, side] : {std::pair("--default-width", &options.svg.defaultWidth),
                                     {"--default-height", &options.svg.defaultHeight}})
        command.add_option(name, *side, "Of an SVG that has neither size nor viewBox, in user units")
            ->check(CLI::PositiveNumber)
            ->capture_default_str();
    addTextOptions(command, options.svg);
}

Source loadSource(Input input, const SourceOptions& options, bool compile) {
    Source source;
    source.name = input.name;
    source.stages = std::move(input.stages);
    if (input.isAsset())
        loadAsset(source, input, options);
    else
        parseSvg(source, input, options);
    input.bytes = {};
    if (options.strict)
        refuseLeftOut(source);
    if (source.scene && compile)
        compileSource(source, options);
    return source;
}

void compileSource(Source& source, const SourceOptions& options) {
    options.paper ? compilePaper(source, options.compiler) : compileScene(source, options.compiler);
    if (options.strict)
        refuseLeftOut(source);
}

void take(Source& source, compiler::Result result) {
    for (const auto& [stage, milliseconds] : result.stages)
        source.stages.emplace_back(stage, milliseconds);
    for (const std::string& warning : result.warnings)
        warn(fmt::format("{}: warning: {}", source.name, warning));
    source.proof = figures(result);
    source.unproven = std::move(result.unproven);
    source.asset = std::move(result.asset);
}

}  // namespace vtm::tools
