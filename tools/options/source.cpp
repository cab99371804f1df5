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

// ---- Text, which is not drawn yet. Scripts use these options already, so they stay. ----------------

using Unused = std::vector<const CLI::Option*>;

void warnOf(const Unused& options) {
    std::vector<std::string> given;
    for (const CLI::Option* option : options)
        if (option->count() > 0)
            given.push_back(option->get_name());
    if (!given.empty())
        warn(fmt::format("vtm: warning: {}: not used yet, since text is not drawn", fmt::join(given, ", ")));
}

Unused addFonts(CLI::App& command, svg::Options& svg) {
    Unused options{
        command.add_option("--font-dir", svg.fontDirectories, "Also take fonts from here (not yet)")
            ->check(CLI::ExistingDirectory),
        command.add_flag("!--no-system-fonts", svg.systemFonts, "Do not use the system's fonts (not yet)")};
    for (const auto& [name, family, generic] : {std::tuple("--serif-family", &svg.serifFamily, "serif"),
                                                {"--sans-serif-family", &svg.sansSerifFamily, "sans-serif"},
                                                {"--cursive-family", &svg.cursiveFamily, "cursive"},
                                                {"--fantasy-family", &svg.fantasyFamily, "fantasy"},
                                                {"--monospace-family", &svg.monospaceFamily, "monospace"}})
        options.push_back(
            command.add_option(name, *family, fmt::format("Font family for '{}' (not yet)", generic)));
    options.push_back(command.add_option("--default-family", svg.defaultFamily,
                                         "Font family where none is named (not yet)"));
    return options;
}

/// Fonts, and what is used already: --default-font-size and --language. A warning names those of the others
/// that were given. A folder of fonts that does not exist is bad usage.
void addTextOptions(CLI::App& command, svg::Options& svg) {
    const std::string group = "Text (not drawn yet)";
    const Unused fonts = addFonts(command, svg);
    for (const CLI::Option* option : fonts)
        command.get_option(option->get_name())->group(group);
    command
        .add_option("--default-font-size", svg.defaultFontSize,
                    "Font size in px where none is given; lengths in em use it")
        ->check(CLI::PositiveNumber)
        ->group(group);
    command.add_option("--language", svg.language, "For systemLanguage, such as en or de-AT")->group(group);
    command.parse_complete_callback([fonts] { warnOf(fonts); });
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

}  // namespace vtm::tools
