#include <charconv>
#include <chrono>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <vtm/asset/container.hpp>
#include <vtm/font/font_maps.hpp>
#include <vtm/font/typesetter.hpp>
#include "tools/commands/commands.hpp"
#include "tools/commands/report.hpp"
#include "tools/input/input.hpp"
#include "tools/output/output.hpp"
#include "tools/process/errors.hpp"
#include "tools/process/limits.hpp"
#include "tools/process/messages.hpp"

namespace vtm::tools {

namespace {

struct FontOptions {
    std::string input, output, characters = "U+0020-U+007E,U+00A0-U+0140", text;
    std::vector<std::string> variations;
    font::Options font;
    bool anew = false, json = false;
};

/// "U+41" or "41", in hexadecimal.
char32_t characterOf(std::string_view text) {
    const std::string_view digits = text.starts_with("U+") || text.starts_with("u+") ? text.substr(2) : text;
    std::uint32_t code = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), code, 16);
    if (error != std::errc() || end != digits.data() + digits.size() || code > 0x10FFFF)
        throw UsageError(fmt::format("--chars: '{}' is not a character such as U+00E9", text));
    return code;
}

/// "all", or ranges and single characters with commas between them.
std::u32string charactersOf(const std::string& ranges, const font::FontMaps& font) {
    if (ranges == "all") {
        const std::vector<char32_t> all = font.characters();
        return {all.begin(), all.end()};
    }
    std::u32string characters;
    for (std::size_t at = 0; at <= ranges.size();) {
        const std::size_t end = std::min(ranges.find(',', at), ranges.size());
        const std::string_view range = std::string_view(ranges).substr(at, end - at);
        const std::size_t dash = std::min(range.find('-'), range.size());
        const char32_t first = characterOf(range.substr(0, dash)),
                       last = dash == range.size() ? first : characterOf(range.substr(dash + 1));
        if (last < first)
            throw UsageError(fmt::format("--chars: the range '{}' runs backwards", range));
        for (char32_t c = first; c <= last; ++c)
            characters += c;
        at = end + 1;
    }
    return characters;
}

font::Variation variationOf(const std::string& text) {
    const std::size_t sign = text.find('=');
    float value = 0;
    if (sign == 4) {
        const char* const last = text.data() + text.size();
        const auto [end, error] = std::from_chars(text.data() + sign + 1, last, value);
        if (error == std::errc() && end == last)
            return {text.substr(0, sign), value};
    }
    throw UsageError(fmt::format("--variation: '{}' is not an axis and its value, such as wght=700", text));
}

/// Glyphs of the file that is to be written, if it is of this font.
bool takeStored(font::FontMaps& font, const std::string& path) {
    if (!isRegularOutput(path) || !std::filesystem::exists(path))
        return false;
    const std::vector<std::uint8_t> bytes = readInput(path).bytes;
    return asset::isContainer(bytes) && font.take(asset::read(bytes));
}

void warnOfMissing(const FontOptions& options, const std::u32string& missing) {
    if (missing.empty())
        return;
    std::string names;
    constexpr std::size_t maxNames = 5;
    for (std::size_t i = 0; i < std::min(missing.size(), maxNames); ++i)
        names += fmt::format("{}U+{:04X}", i > 0 ? ", " : "", std::uint32_t(missing[i]));
    if (missing.size() > maxNames)
        names += fmt::format(" and {} more", missing.size() - maxNames);
    warn(fmt::format("{}: warning: the font has no {}", nameOf(options.input), names));
}

Json makeFont(const FontOptions& options) {
    font::FontMaps font(readInput(options.input).bytes, options.font);
    const bool isStored = !options.anew && takeStored(font, options.output);
    const std::size_t known = font.glyphCount();
    std::u32string wanted = charactersOf(options.characters, font);
    wanted += font::fromUtf8(options.text);
    const auto start = std::chrono::steady_clock::now();
    const std::u32string missing = font.addCharacters(wanted);
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
    warnOfMissing(options, missing);
    const asset::Asset asset = font.asset();
    if (asset.glyphParts.empty() && font.glyphCount() > 1)
        warn(fmt::format("{}: warning: none of these glyphs has an outline", nameOf(options.input)));
    const std::vector<std::uint8_t> bytes = asset::write(asset);
    writeOutput(options.output, bytes);
    const std::size_t made = font.glyphCount() - known;
    Json report = {
        {"input", options.input},
        {"output", options.output},
        {"family", font.family()},
        {"file_bytes", bytes.size()},
        {"glyphs", font.glyphCount()},
        {"glyphs_compiled", made},
        {"file_was_extended", isStored},
        {"parts", asset.maps.size() - 1},
        {"missing_characters", missing.size()},
        {"bytes_per_glyph", double(bytes.size()) / double(std::max<std::size_t>(1, font.glyphCount()))},
        {"microseconds_per_glyph", made == 0 ? 0 : took.count() / double(made)}};
    report.update(figures(asset));
    return report;
}

int run(FontOptions options) {
    requireSuffix(options.output, {".vtm"});
    if (options.json)
        refuseMixture(options.output, "the figures of --json");
    refuseLoss({options.input}, {options.output});
    for (const std::string& variation : options.variations)
        options.font.variations.push_back(variationOf(variation));
    const PictureLimits limits(nameOf(options.input), true);
    try {
        const Json report = makeFont(options);
        if (options.json)
            print(jsonText(report));
    } catch (const UsageError&) {
        throw;
    } catch (...) {
        say(describeError(nameOf(options.input)));
        return badInput;
    }
    return done;
}

}  // namespace

void addFont(CLI::App& app, int& exitCode) {
    const auto options = std::make_shared<FontOptions>();
    CLI::App* command = app.add_subcommand("font", "Make a .vtm file of a font's glyphs");
    command
        ->add_option("IN", options->input, "OpenType, TrueType, WOFF or WOFF2 file, or - for standard input")
        ->required();
    command
        ->add_option("-o,--output", options->output,
                     "The .vtm file, or - for standard output. One of this font is extended")
        ->required();
    command
        ->add_option("--chars", options->characters,
                     "Characters: U+0041 or ranges U+0041-U+005A, with commas between them; or all")
        ->capture_default_str();
    command->add_option("--text", options->text, "The characters of this text too");
    command->add_option("--face", options->font.face, "The face of a collection, from 0")
        ->capture_default_str();
    command->add_option("--variation", options->variations,
                        "An axis of a variable font and its value: wght=700");
    command->add_option("--tolerance", options->font.tolerance, "Max error of outlines, as a share of the em")
        ->check(CLI::Range(0x1p-22, 0x1p-8));
    command->add_flag("--anew", options->anew, "Replace a file that is there instead of extending it");
    command->add_flag("--json", options->json, "Print figures as JSON");
    command->footer(
        "Examples:\n  vtm font DejaVuSerif.ttf -o serif.vtm\n  vtm font Amiri.ttf -o amiri.vtm --chars all "
        "--json\n"
        "  vtm font Inter.woff2 -o bold.vtm --variation wght=700 --chars U+0020-U+007E --text Grüße");
    command->callback([options, &exitCode] { exitCode = run(*options); });
}

}  // namespace vtm::tools
