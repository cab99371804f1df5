#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include "tools/options/options.hpp"
#include "tools/process/errors.hpp"
#include "tools/process/messages.hpp"

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
        throw UsageError(fmt::format("--mode: '{}' is not one of exact, compat, paper", name));
    options.mode = mode->second;
    options.compiler.mode = mode->second;
}

// ---- Text ------------------------------------------------------------------------------------------

void addFonts(CLI::App& command, text::FontOptions& fonts) {
    command.add_option("--font-dir", fonts.directories, "Also take fonts from here, before the system's")
        ->check(CLI::ExistingDirectory);
    command.add_flag("!--no-system-fonts", fonts.systemFonts, "Do not use the system's fonts");
    for (const auto& [name, family, generic] : {std::tuple("--serif-family", &fonts.serifFamily, "serif"),
                                                {"--sans-serif-family", &fonts.sansSerifFamily, "sans-serif"},
                                                {"--cursive-family", &fonts.cursiveFamily, "cursive"},
                                                {"--fantasy-family", &fonts.fantasyFamily, "fantasy"},
                                                {"--monospace-family", &fonts.monospaceFamily, "monospace"}})
        command.add_option(name, *family, fmt::format("Font family for '{}'", generic))
            ->capture_default_str();
    command.add_option("--default-family", fonts.defaultFamily, "Font family where none is named")
        ->capture_default_str();
}

void addTextOptions(CLI::App& command, svg::Options& svg) {
    CLI::App* const group = command.add_option_group("Text");
    addFonts(*group, svg.fonts);
    group
        ->add_option("--default-font-size", svg.defaultFontSize,
                     "Font size in px where none is given; lengths in em use it")
        ->check(CLI::PositiveNumber);
    group->add_option("--language", svg.language, "Of text and for systemLanguage, such as en or de-AT");
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
            "Max error of boundaries, as a share of the longer side; by default render chooses one that fits "
            "the view unless it is given")
        ->each([&options](const std::string&) { options.hasTolerance = true; })
        ->check(CLI::Range(std::ldexp(1.0, -26), std::ldexp(1.0, -6)))
        ->capture_default_str();
    addImportOptions(command, options);
}

void addImportOptions(CLI::App& command, SourceOptions& options) {
    command.add_option("--dpi", options.svg.dpi, "User units per inch, for lengths such as 1in or 2cm")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command.add_flag("--strict", options.strict,
                     "Fail with exit code 1 and write nothing if anything is left out or repaired");
    command.add_option("-s,--stylesheet", options.styleSheet,
                       "CSS file that applies before the SVG's own style sheets");
    for (const auto& [name, side] : {std::pair("--default-width", &options.svg.defaultWidth),
                                     {"--default-height", &options.svg.defaultHeight}})
        command.add_option(name, *side, "Side in user units of an SVG with neither size nor viewBox")
            ->check(CLI::PositiveNumber)
            ->capture_default_str();
    addTextOptions(command, options.svg);
}

void addExportId(CLI::App& command, std::string& id, const std::string& description) {
    command.add_option("-i,--export-id", id, description)->check([](const std::string& given) {
        return std::string(given.empty() ? "the id is empty" : "");
    });
}

}  // namespace vtm::tools
