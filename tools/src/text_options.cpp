#include "tools/src/text_options.hpp"

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tools/src/report.hpp"

namespace vtm::tools {

namespace {

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
        command.add_option("--font-dir", svg.fontDirectories, "Take fonts from here too (not yet)")
            ->check(CLI::ExistingDirectory),
        command.add_flag("!--no-system-fonts", svg.systemFonts, "Do without the system's fonts (not yet)")};
    for (const auto& [name, family, generic] : {std::tuple("--serif-family", &svg.serifFamily, "serif"),
                                                {"--sans-serif-family", &svg.sansSerifFamily, "sans-serif"},
                                                {"--cursive-family", &svg.cursiveFamily, "cursive"},
                                                {"--fantasy-family", &svg.fantasyFamily, "fantasy"},
                                                {"--monospace-family", &svg.monospaceFamily, "monospace"}})
        options.push_back(
            command.add_option(name, *family, fmt::format("What '{}' means (not yet)", generic)));
    options.push_back(
        command.add_option("--default-family", svg.defaultFamily, "Where none is named (not yet)"));
    return options;
}

}  // namespace

void addTextOptions(CLI::App& command, svg::Options& svg) {
    const std::string group = "Text (not drawn yet)";
    const Unused fonts = addFonts(command, svg);
    for (const CLI::Option* option : fonts)
        command.get_option(option->get_name())->group(group);
    command
        .add_option("--default-font-size", svg.defaultFontSize,
                    "In px, where none is given; lengths in em use it")
        ->check(CLI::PositiveNumber)
        ->group(group);
    command.add_option("--language", svg.language, "For systemLanguage, such as en or de-AT")->group(group);
    command.parse_complete_callback([fonts] { warnOf(fonts); });
}

}  // namespace vtm::tools
