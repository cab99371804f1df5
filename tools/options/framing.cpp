#include <charconv>
#include <cmath>
#include <map>
#include <string>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include <vtm/raster/view.hpp>
#include "tools/options/options.hpp"
#include "tools/process/errors.hpp"

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

}  // namespace vtm::tools
