#include <memory>

#include <fmt/format.h>

#include <vtm/image/codec.hpp>
#include "conformance/compare/compare.hpp"
#include "tools/src/commands.hpp"
#include "tools/src/input.hpp"
#include "tools/src/limits.hpp"
#include "tools/src/output.hpp"
#include "tools/src/report.hpp"
#include "tools/src/standard_output.hpp"

namespace vtm::tools {

namespace {

struct DiffOptions {
    std::string first, second, output;
    double threshold = 2;
    bool json = false;
};

Json report(const compare::Difference& difference) {
    return {{"max", difference.max},       {"mean", difference.mean}, {"rms", difference.rms},
            {"p999", difference.p999},     {"over", difference.over}, {"worst_x", difference.worstX},
            {"worst_y", difference.worstY}};
}

image::Raster readPicture(const std::string& path) {
    const Input input = readInput(path);
    return compare::readPng(input.bytes, input.name);
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
            throw std::invalid_argument(fmt::format("is {} x {} pixels, {} is {} x {}", b.width, b.height,
                                                    options.first, a.width, a.height));
        const Json figures = report(compare::compare(a, b, options.threshold));
        reading = options.output;
        if (!options.output.empty())
            writePicture(a, b, options.output);
        print(options.json ? jsonText(figures) : toText(figures));
    } catch (...) {
        say(describeError(reading));
        return badInput;
    }
    return done;
}

}  // namespace

void addDiff(CLI::App& app, int& exitCode) {
    const auto options = std::make_shared<DiffOptions>();
    CLI::App* command =
        app.add_subcommand("diff", "Say how far two PNG files are apart, in 1/255 of a channel");
    command->add_option("A", options->first, "PNG file, or - for standard input")->required();
    command->add_option("B", options->second, "PNG file, or -")->required();
    command->add_option("-o,--output", options->output, "Write the differences as a picture");
    command->add_option("--threshold", options->threshold, "'over' counts pixels beyond this")
        ->capture_default_str();
    command->add_flag("--json", options->json, "As JSON");
    command->callback([options, &exitCode] { exitCode = diff(*options); });
}

}  // namespace vtm::tools
