#include "tools/input/source.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vtm/asset/container.hpp>
#include "tools/input/bounds.hpp"
#include "tools/process/messages.hpp"

namespace vtm::tools {

namespace {

// ---- What is left out -----------------------------------------------------------------------------

using Kind = svg::Warning::Kind;

std::string placeOf(const svg::Location& where) {
    return fmt::format("{}:{}:{}", where.file, where.line, where.column);
}

bool isNotDrawnYet(const svg::Warning& warning) { return warning.kind == Kind::Filter; }

/// One line for all, at the first in the file.
void warnOfNotDrawnYet(Source& source, const std::vector<svg::Warning>& warnings) {
    const auto filters = std::ranges::find_if(warnings, isNotDrawnYet);
    if (filters != warnings.end())
        warnOf(source, fmt::format("{}: warning: {} {} not drawn yet", placeOf(filters->where),
                                   filters->count, filters->count == 1 ? "filter is" : "filters are"));
}

// ---- Loading --------------------------------------------------------------------------------------

void loadAsset(Source& source, const Input& input, const SourceOptions& options) {
    if (options.paper)
        throw std::runtime_error("is a .vtm file; paper mode only draws SVG files");
    if (!options.svg.exportId.empty() || !options.styleSheet.empty())
        throw std::runtime_error("is a .vtm file; --export-id and --stylesheet need an SVG file");
    source.asset = timed(source.stages, "parse", [&] { return asset::read(input.bytes); });
    if (options.mode && *options.mode != source.asset->mode)
        throw std::runtime_error("was compiled in another mode than --mode");
    source.width = source.asset->width;
    source.height = source.asset->height;
}

std::string readStyleSheet(const std::string& path) {
    const Input sheet = readInput(path);
    return {sheet.bytes.begin(), sheet.bytes.end()};
}

scene::Rect exportedBounds(const svg::Document& document, const std::string& id) {
    if (const auto bounds = drawnBounds(document.scene))
        return *bounds;
    throw std::runtime_error(fmt::format("#{}: the element draws nothing inside the picture", id));
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
    if (!options.exportId.empty())
        source.exported = exportedBounds(document, options.exportId);
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
    source.proof = Proof{result.provenError, std::move(result.unproven), result.sampledStrokes};
    source.asset = std::move(result.asset);
}

void warnOf(Source& source, const std::string& message) {
    warn(message);
    ++source.leftOut;
}

void warnOf(Source& source, const std::vector<svg::Warning>& warnings) {
    warnOfNotDrawnYet(source, warnings);
    for (const svg::Warning& warning : warnings)
        if (!isNotDrawnYet(warning))
            warnOf(source, fmt::format("{}: warning: {}", placeOf(warning.where), warning.message));
}

void refuseLeftOut(const Source& source) {
    if (source.leftOut > 0)
        throw std::runtime_error("--strict: nothing is written, because something is left out or repaired");
}

}  // namespace vtm::tools
