#include "tools/src/source.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include <fmt/core.h>

#include "asset/container.hpp"
#include "image/codec.hpp"
#include "tools/src/commands.hpp"
#include "tools/src/limits.hpp"

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

void addFontOptions(CLI::App& command, svg::Options& svg) {
    const std::string group = "Text";
    command.add_option("--font-dir", svg.fontDirectories, "Take fonts from here too")->group(group);
    command.add_flag("!--no-system-fonts", svg.systemFonts, "Do without the system's fonts")->group(group);
    command.add_option("--serif-family", svg.serifFamily, "What 'serif' means")->group(group);
    command.add_option("--sans-serif-family", svg.sansSerifFamily, "What 'sans-serif' means")->group(group);
    command.add_option("--cursive-family", svg.cursiveFamily, "What 'cursive' means")->group(group);
    command.add_option("--fantasy-family", svg.fantasyFamily, "What 'fantasy' means")->group(group);
    command.add_option("--monospace-family", svg.monospaceFamily, "What 'monospace' means")->group(group);
    command.add_option("--default-family", svg.defaultFamily, "Where none is named")->group(group);
    command.add_option("--default-font-size", svg.defaultFontSize, "In px, where none is given")
        ->check(CLI::PositiveNumber)
        ->group(group);
    command.add_option("--language", svg.language, "For systemLanguage, such as en or de-AT")->group(group);
}

std::vector<std::uint8_t> readBytes(const std::string& path, Stages& stages) {
    return timed(stages, "read", [&] { return image::readFile(path); });
}

void loadAsset(Source& source, const std::string& path, const SourceOptions& options) {
    if (options.paper)
        throw std::runtime_error("is compiled; paper mode draws SVG files only");
    const auto bytes = readBytes(path, source.stages);
    source.asset = timed(source.stages, "parse", [&] { return asset::read(bytes); });
    if (options.mode && *options.mode != source.asset->mode)
        throw std::runtime_error("was compiled in the other mode than --mode asks for");
    source.width = source.asset->width;
    source.height = source.asset->height;
}

void parseSvg(Source& source, const std::string& path, svg::Options options) {
    options.fileName = path;
    options.resourceDirectory = std::filesystem::absolute(path).parent_path().string();
    const auto bytes = readBytes(path, source.stages);
    svg::Document document = timed(source.stages, "parse", [&] { return svg::load(bytes, options); });
    for (const svg::Warning& warning : document.warnings)
        printWarning(fmt::format("{}:{}:{}: warning: {}", warning.where.file, warning.where.line,
                                 warning.where.column, warning.message));
    source.width = document.scene.width;
    source.height = document.scene.height;
    source.scene = std::move(document.scene);
}

void printWarnings(const std::string& path, const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings)
        printWarning(fmt::format("{}: warning: {}", path, warning));
}

void compilePaper(Source& source, const std::string& path, const compiler::Options& options) {
    compiler::PaperOptions paper;
    paper.tolerance = options.tolerance;
    compiler::PaperResult result =
        timed(source.stages, "compile", [&] { return compiler::compilePaper(*source.scene, paper); });
    printWarnings(path, result.warnings);
    source.paper = std::move(result);
}

/// With the tolerance asked for, as long as that takes no more than a third of the limit; then with a coarser
/// one that the raster hides.
compiler::Result compileInTime(const Source& source, const std::string& path, compiler::Options options,
                               double coarser) {
    const double seconds = secondsForFirstTry();
    if (coarser < 2 * options.tolerance || seconds <= 0)
        return compiler::compile(*source.scene, options);
    try {
        limits::Limits limits = limits::current().budget->limits();
        limits.seconds = seconds;
        limits.overrunHandler = {};
        limits::Budget budget(limits);
        const limits::Scope scope(budget);
        return compiler::compile(*source.scene, options);
    } catch (const limits::Exceeded& exceeded) {
        if (exceeded.limit() == limits::Limit::Cancelled)
            throw;
    }
    options.tolerance = coarser;
    compiler::Result result = compiler::compile(*source.scene, options);
    printWarning(path + ": warning: takes long; edges may be off by a sixteenth of a pixel");
    return result;
}

void compileScene(Source& source, const std::string& path, const SourceOptions& options) {
    constexpr double coarsest = 0x1p-6;  // compiler::Options::tolerance
    const double coarser =
        options.coarserTolerance ? options.coarserTolerance(source.width, source.height) : 0;
    compiler::Result result = timed(source.stages, "compile", [&] {
        return compileInTime(source, path, options.compiler, std::min(coarser, coarsest));
    });
    for (const auto& [stage, milliseconds] : result.stages)
        source.stages.emplace_back(stage, milliseconds);
    printWarnings(path, result.warnings);
    source.proof = figures(result);
    source.unproven = std::move(result.unproven);
    source.asset = std::move(result.asset);
}

}  // namespace

void addSourceOptions(CLI::App& command, SourceOptions& options) {
    command.add_option_function<std::string>(
        "--mode", [&options](const std::string& name) { chooseMode(options, name); },
        "exact: no seams (default); compat: layer by layer, as other renderers do; paper: as published in "
        "2005, to compare with");
    // The compiler's own range (compiler::Options::tolerance).
    command
        .add_option("--tolerance", options.compiler.tolerance,
                    "How far a boundary may be off, as a share of the longer side")
        ->check(CLI::Range(std::ldexp(1.0, -26), std::ldexp(1.0, -6)))
        ->capture_default_str();
    command.add_option("--dpi", options.svg.dpi, "Pixels an inch")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    addFontOptions(command, options.svg);
}

Source loadSource(const std::string& path, const SourceOptions& options, bool compile) {
    Source source;
    if (std::filesystem::path(path).extension() == ".vtm") {
        loadAsset(source, path, options);
    } else {
        parseSvg(source, path, options.svg);
        if (compile && options.paper)
            compilePaper(source, path, options.compiler);
        else if (compile)
            compileScene(source, path, options);
    }
    return source;
}

}  // namespace vtm::tools
