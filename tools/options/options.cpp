#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/core.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <vtm/raster/view.hpp>
#include <vtm/scene/scene.hpp>
#include <vtm/svg/load.hpp>
#include "tools/options/options.hpp"
#include "tools/process/errors.hpp"
#include "tools/process/limits.hpp"
#include "tools/process/messages.hpp"

namespace vtm::tools {

namespace {

double parseNumber(const char*& at, const char* end) {
    double value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc() || !std::isfinite(value))
        throw UsageError("--view: needs four numbers: x,y,width,height");
    at = next;
    return value;
}

scene::Rect parseView(const std::string& text) {
    const char* at = text.data();
    const char* const end = at + text.size();
    double numbers[4];
    for (int i = 0; i < 4; ++i) {
        if (i > 0 && (at == end || *at++ != ','))
            throw UsageError("--view: needs four numbers: x,y,width,height");
        numbers[i] = parseNumber(at, end);
    }
    if (at != end || numbers[2] <= 0 || numbers[3] <= 0)
        throw UsageError("--view: needs x,y,width,height with width and height above zero");
    return {numbers[0], numbers[1], numbers[2], numbers[3]};
}

const std::map<std::string, scene::Fit> fits{
    {"contain", scene::Fit::Contain}, {"cover", scene::Fit::Cover}, {"stretch", scene::Fit::Stretch}};

scene::Fit parseFit(const std::string& name) {
    const auto fit = fits.find(name);
    if (fit == fits.end())
        throw UsageError(fmt::format("--fit: '{}' is not one of contain, cover, stretch", name));
    return fit->second;
}

double parseRotation(const std::string& text) {
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto [next, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || next != end || !std::isfinite(value))
        throw UsageError(fmt::format("--rotate: '{}' is not a number of degrees", text));
    return value;
}

void addSize(CLI::App& command, scene::Framing& framing) {
    const auto side = CLI::Range(1, asset::maxViewSide);
    auto* width =
        command.add_option("-w,--width", framing.width, "Width in pixels; alone it keeps the aspect ratio");
    auto* height = command.add_option("-h,--height", framing.height,
                                      "Height in pixels; alone it keeps the aspect ratio");
    width->check(side);
    height->check(side);
    command.add_option("-z,--zoom,--scale", framing.scale, "Pixels per user unit")
        ->check(CLI::PositiveNumber)
        ->excludes(width)
        ->excludes(height);
}

}  // namespace

void addFramingOptions(CLI::App& command, scene::Framing& framing) {
    // -h is the height here, as rsvg-convert and resvg have it.
    command.set_help_flag("--help", "Print this help message and exit");
    addSize(command, framing);
    command.add_option_function<std::string>(
        "--fit", [&framing](const std::string& name) { framing.placement.fit = parseFit(name); },
        "With both --width and --height: contain (all of the picture, centred; default), cover (no pixel is "
        "left "
        "empty) or stretch");
    command.add_option_function<std::string>(
        "--view", [&framing](const std::string& text) { framing.part = parseView(text); },
        "x,y,width,height in user units: the part that is drawn, instead of the whole picture");
    command.add_option_function<std::string>(
        "--rotate", [&framing](const std::string& text) { framing.rotation = parseRotation(text); },
        "Degrees clockwise; the raster grows to hold the rotated picture");
}

namespace {

image::FileFormat parseFormat(const std::string& name) {
    if (const auto format = image::formatOfSuffix("." + name))
        return *format;
    throw UsageError(fmt::format("--format: '{}' is not one of png, jpeg, webp, ppm", name));
}

}  // namespace

void addFileOptions(CLI::App& command, FileOptions& options) {
    command.add_option_function<std::string>(
        "-f,--format", [&options](const std::string& name) { options.format = parseFormat(name); },
        "png (default), jpeg, webp or ppm, for outputs without a suffix: directories, standard output");
    command.add_option("--depth", options.encoding.depth, "Bits per channel of PNG and PPM: 8 or 16")
        ->check(CLI::IsMember({8, 16}))
        ->capture_default_str();
    command
        .add_option("--quality", options.encoding.quality,
                    "Quality of JPEG (default 90), or of lossy WebP (lossless by default)")
        ->check(CLI::Range(1, 100));
}

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
    group->add_option("--resource-root", svg.resourceRoot,
                      "Files that pictures refer to are read below this folder only");
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
    command.add_flag("--no-instances{false}", options.compiler.instances,
                     "Store shapes that repeat each time, not once");
    command
        .add_option(
            "--filter-pixels", options.compiler.filterPixels,
            "Draw what is filtered now, as an image of so many pixels along the picture's longer side; 0: "
            "compute filters whenever the picture is drawn")
        ->check(CLI::Range(0u, compiler::maxFilterPixels));
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

namespace {

double parseLimit(const char* option, const std::string& text) {
    if (text == "none")
        return 0;
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !(value >= 0 && value <= 1e12))
        throw UsageError(fmt::format("{}: '{}' is neither a number >= 0 nor 'none'", option, text));
    return value;
}

}  // namespace

void addLimitOptions(CLI::App& command) {
    const std::string group = "Limits";
    command
        .add_option_function<std::string>(
            "--max-seconds",
            [](const std::string& text) { setMaxSeconds(parseLimit("--max-seconds", text)); },
            "Give up a picture after this many seconds of CPU or wall time; 0 or none: no limit (default 60)")
        ->group(group);
    command
        .add_option_function<std::string>(
            "--max-memory",
            [](const std::string& text) { setMaxMegabytes(parseLimit("--max-memory", text)); },
            "Give up a picture at this many MB of resident memory; 0 or none: no limit (default 4096)")
        ->group(group);
}

namespace {

/// What a colour is made of: nothing that could end the attribute it is put into.
bool plain(const std::string& text) {
    return std::all_of(text.begin(), text.end(), [](unsigned char c) {
        return std::isalnum(c) != 0 || std::string_view("#(),.%/ -+").find(char(c)) != std::string_view::npos;
    });
}

/// Asks the importer, so that the command knows exactly the colours that the files may use. An
/// invalid fill falls back to the inherited `none`, which leaves no item behind.
const scene::Item* filledItem(const scene::Group& group) {
    for (const scene::Node& node : group.children) {
        if (const auto* item = std::get_if<scene::Item>(&node.value))
            return item;
        if (const auto* inner = filledItem(std::get<scene::Group>(node.value)))
            return inner;
    }
    return nullptr;
}

}  // namespace

scene::Color parseColor(const std::string& text) {
    if (text == "transparent" || text == "none")
        return {0, 0, 0, 0};
    if (plain(text)) {
        const std::string document = fmt::format(
            R"(<svg xmlns="http://www.w3.org/2000/svg" width="1" height="1" fill="none"><path d="M0 0H1V1Z" fill="{}"/></svg>)",
            text);
        const auto* bytes = reinterpret_cast<const std::uint8_t*>(document.data());
        const svg::Document loaded = svg::load({bytes, document.size()});
        if (const scene::Item* item = filledItem(loaded.scene.root)) {
            scene::Color color = std::get<scene::Color>(item->paint);
            color.a *= item->opacity;
            return color;
        }
    }
    throw UsageError(fmt::format("--background: '{}' is not a colour", text));
}

void addExportId(CLI::App& command, std::string& id, const std::string& description) {
    command.add_option("-i,--export-id", id, description)->check([](const std::string& given) {
        return std::string(given.empty() ? "the id is empty" : "");
    });
}

}  // namespace vtm::tools
