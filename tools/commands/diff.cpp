#include <memory>
#include <optional>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <vtm/image/codec.hpp>
#include "conformance/compare/compare.hpp"
#include "tools/commands/commands.hpp"
#include "tools/commands/report.hpp"
#include "tools/input/input.hpp"
#include "tools/options/options.hpp"
#include "tools/output/output.hpp"
#include "tools/process/errors.hpp"
#include "tools/process/limits.hpp"
#include "tools/process/messages.hpp"

namespace vtm::tools {

namespace {

struct DiffOptions {
    std::string first, second, output;
    double threshold = 2;
    std::optional<double> max, mean;
    bool json = false;
};

Json report(const compare::Difference& difference) {
    return {{"max", difference.max},       {"mean", difference.mean}, {"rms", difference.rms},
            {"p999", difference.p999},     {"over", difference.over}, {"worst_x", difference.worstX},
            {"worst_y", difference.worstY}};
}

/// PNG with all of its depth, or what else is read.
image::Raster readPicture(const std::string& path) {
    const Input input = readInput(path);
    const bool isOther = input.bytes.size() > 4 && input.bytes[0] != 0x89;
    return isOther ? image::toRaster(image::decode(input.bytes)) : compare::readPng(input.bytes, input.name);
}

/// Whether the pictures are as near as was asked for; says so where they are not. NaN is not near.
bool isWithin(const char* option, const std::optional<double>& limit, double value) {
    constexpr double rounding = 255 * 0x1p-22;  // of premultiplied floats in [0, 1] and their difference
    if (!limit || value <= *limit + rounding)
        return true;
    say(fmt::format("vtm: {} {:g}: exceeded, the value is {:.4g}", option, *limit, value));
    return false;
}

void writePicture(const image::Raster& a, const image::Raster& b, const std::string& path) {
    writeOutput(path, image::encodePng(compare::differencePicture(a, b)));
}

int diff(const DiffOptions& options) {
    if (!options.output.empty()) {
        requireSuffix(options.output, {".png"});
        refuseMixture(options.output, "the figures");
        refuseLoss({options.first, options.second}, {options.output});
    }
    std::string reading = nameOf(options.first);
    const PictureLimits limits(reading, true);
    try {
        const image::Raster a = readPicture(options.first);
        reading = nameOf(options.second);
        const image::Raster b = readPicture(options.second);
        if (a.width != b.width || a.height != b.height)
            throw std::invalid_argument(fmt::format("is {} x {} pixels, {} is {} x {}", readable(b.width),
                                                    readable(b.height), nameOf(options.first),
                                                    readable(a.width), readable(a.height)));
        const compare::Difference difference = compare::compare(a, b, options.threshold);
        const Json figures = report(difference);
        reading = options.output;
        if (!options.output.empty())
            writePicture(a, b, options.output);
        print(options.json ? jsonText(figures) : toText(figures));
        const bool isMax = isWithin("--max", options.max, difference.max);
        const bool isMean = isWithin("--mean", options.mean, difference.mean);
        return isMax && isMean ? done : badInput;
    } catch (...) {
        say(describeError(reading));
        return badInput;
    }
}

}  // namespace

void addDiff(CLI::App& app, int& exitCode) {
    const auto options = std::make_shared<DiffOptions>();
    CLI::App* command = app.add_subcommand("diff", "Show how far two pictures differ, in 1/255 of a channel");
    command->add_option("A", options->first, "PNG, JPEG, WebP, GIF or AVIF file, or - for standard input")
        ->required();
    command->add_option("B", options->second, "The same, or -")->required();
    command->add_option("-o,--output", options->output, "Write the differences as a PNG picture");
    command
        ->add_option("--threshold", options->threshold,
                     "Count pixels that differ by more than this, as 'over'")
        ->capture_default_str();
    for (const auto& [name, limit] : {std::pair("--max", &options->max), {"--mean", &options->mean}})
        command->add_option(name, *limit, fmt::format("Exit code 1 if '{}' is larger than this", name + 2))
            ->check(CLI::NonNegativeNumber);
    command->add_flag("--json", options->json, "Print the figures as JSON");
    command->footer(
        "Examples:\n  vtm diff a.png b.png\n  vtm diff a.png b.png --max 2 --mean 0.01 -o differences.png");
    command->callback([options, &exitCode] { exitCode = diff(*options); });
}

}  // namespace vtm::tools
