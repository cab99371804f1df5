#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <vtm/compiler/pick.hpp>
#include "tools/commands/commands.hpp"
#include "tools/engines/debug_view.hpp"
#include "tools/input/input.hpp"
#include "tools/input/source.hpp"
#include "tools/options/options.hpp"
#include "tools/output/output.hpp"
#include "tools/process/errors.hpp"
#include "tools/process/limits.hpp"
#include "tools/process/messages.hpp"
#include "web/page.hpp"

namespace vtm::tools {

namespace {

struct ViewOptions {
    std::string input, output;
    SourceOptions source;
};

web::Rgb toBytes(glm::vec3 color) {
    const auto byte = [](float c) { return std::uint8_t(std::lround(255 * c)); };
    return {byte(color.r), byte(color.g), byte(color.b)};
}

web::View debugPage(const Source& source, DebugView view, const char* name, const char* title) {
    web::View page{name, title, debugAsset(*source.asset, view), {}, {}};
    const auto unproven = source.proof ? source.proof->unproven : std::vector<compiler::UnprovenSquare>();
    for (const DebugOutline& o : debugOutlines(*source.asset, unproven, view))
        page.outlines.push_back({o.corner.x, o.corner.y, o.size.x, o.size.y, toBytes(o.color)});
    for (const DebugMark& mark : debugLegend(view))
        page.legend.push_back({toBytes(mark.color), mark.text});
    return page;
}

std::vector<web::View> debugPages(const Source& source) {
    std::vector<web::View> views;
    views.push_back(debugPage(source, DebugView::Cells, "cells", "Cells"));
    views.push_back(debugPage(source, DebugView::Depth, "depth", "Depth"));
    views.push_back(debugPage(source, DebugView::Pieces, "pieces", "Pieces"));
    views.push_back(debugPage(source, DebugView::Cost, "cost", "Cost"));
    views.push_back(debugPage(source, DebugView::Regions, "regions", "Regions"));
    if (source.proof && !source.proof->unproven.empty())
        views.push_back(debugPage(source, DebugView::Fallback, "fallback", "Fallback"));
    return views;
}

/// Found as exactly as files are drawn.
web::Ids itemsOf(const scene::Scene& scene) {
    compiler::Options options;
    options.instances = false;  // ids need it
    compiler::PickMap map = compiler::compilePickMap(scene, options);
    web::Ids ids;
    for (const auto& item : map.itemOfPaint)
        ids.idOfPaint.push_back(item ? *item + 1 : 0);
    for (const scene::Item* item : map.items) {
        const bool isStroke = std::holds_alternative<scene::StrokeStyle>(item->geometry);
        ids.items.push_back({item->place.element, item->place.line, item->place.column, isStroke});
    }
    ids.asset = std::move(map.asset);
    return ids;
}

/// Of an asset without its scene.
std::optional<web::Ids> regionsOf(const asset::Asset& asset) {
    if (!asset.instances.empty())
        return std::nullopt;
    web::Ids ids{asset, {}, {}};
    for (std::size_t i = 0; i < asset.paints.size(); ++i)
        ids.idOfPaint.push_back(std::uint32_t(i));
    return ids;
}

std::optional<web::Ids> idsOf(const Source& source) {
    if (!source.scene)
        return regionsOf(*source.asset);
    try {
        return itemsOf(*source.scene);
    } catch (const compiler::LimitError& error) {
        warn(fmt::format("{}: warning: the page does not name items: {}", source.name, error.what()));
        return std::nullopt;
    }
}

/// Before files told, nearly all were compiled with the usual tolerance.
double finestPixelOf(const asset::Asset& asset) {
    const double usual =
        compiler::Options().tolerance * std::max(asset.width, asset.height) / asset::finestShare;
    return asset.finestPixel.value_or(usual);
}

void refuseFilters(const asset::Asset& asset) {
    if (!asset.filters.empty())
        throw std::runtime_error(
            "has filters that are computed when it is drawn; compile it with --filter-pixels, or view its "
            "SVG file");
}

std::string titleOf(const std::string& input) {
    return input == standardStream ? nameOf(input) : std::filesystem::path(input).filename().string();
}

/// In the current folder.
std::string pageFor(const std::string& input) {
    if (input == standardStream)
        throw UsageError("view: the page of standard input needs a name: -o PAGE.html");
    return std::filesystem::path(input).filename().string() + ".html";
}

std::string pageOf(const ViewOptions& options) {
    Input input = readInput(options.input);
    const bool isSvg = !input.isAsset() && !input.isTree();
    std::vector<std::uint8_t> svg = isSvg ? input.bytes : std::vector<std::uint8_t>();
    Source source = loadSource(std::move(input), options.source);
    refuseFilters(*source.asset);
    web::Source page{titleOf(options.input),       {},
                     finestPixelOf(*source.asset), idsOf(source),
                     debugPages(source),           std::move(svg)};
    page.picture = std::move(*source.asset);
    return web::page(page);
}

int view(ViewOptions options) {
    if (options.source.paper || options.source.mode == asset::Mode::Compat)
        throw UsageError("view: a page shows exact mode only; see render --mode");
    if (options.output.empty())
        options.output = pageFor(options.input);
    requireSuffix(options.output, {".html", ".htm"});
    refuseLoss({options.input}, {options.output});
    const PictureLimits limits(nameOf(options.input), true);
    try {
        const std::string page = pageOf(options);
        writeOutput(options.output, {reinterpret_cast<const std::uint8_t*>(page.data()), page.size()});
    } catch (...) {
        say(describeError(nameOf(options.input)));
        return badInput;
    }
    return done;
}

/// Where the user chose none. Filters are drawn once, finely enough for a window. A page zooms four times
/// closer than usual assets would let it, which costs a seventh of their size.
constexpr unsigned usualFilterPixels = 1024;
constexpr double usualTolerance = 0x1p-18;

}  // namespace

void addView(CLI::App& app, int& exitCode) {
    const auto options = std::make_shared<ViewOptions>();
    options->source.compiler.filterPixels = usualFilterPixels;
    options->source.compiler.tolerance = usualTolerance;
    CLI::App* command =
        app.add_subcommand("view", "Make a page that shows a picture in any browser, at any zoom");
    command->add_option("FILE", options->input, "SVG, .vtmtree or .vtm file, or - for standard input")
        ->required();
    command->add_option("-o,--output", options->output,
                        "The page, or - for standard output; FILE.html in the current folder if not given");
    addSourceOptions(*command, options->source);
    command->footer(
        "The page is one file and needs no server: WebGL 2 draws it with VTM's own shaders.\n\n"
        "Examples:\n  vtm view tiger.svg\n  vtm view tiger.svg -o page.html\n  vtm view map.svg --tolerance "
        "1e-6\n"
        "  vtm view tiger.vtm -o - > page.html");
    command->callback([options, &exitCode] { exitCode = view(*options); });
}

}  // namespace vtm::tools
