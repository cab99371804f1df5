#include "trace/trace.hpp"

#include <memory>

#include <fmt/core.h>

#include "asset/container.hpp"
#include "image/codec.hpp"
#include "svg/write.hpp"
#include "tools/src/commands.hpp"
#include "tools/src/limits.hpp"
#include "tools/src/source.hpp"

namespace vtm::tools {

namespace {

struct TraceOptions {
    std::string input, output;
    trace::Options trace;
    compiler::Options compiler;
};

bool endsWith(const std::string& path, const std::string& suffix) {
    return path.size() >= suffix.size() &&
           path.compare(path.size() - suffix.size(), suffix.size(), suffix) == 0;
}

int run(const TraceOptions& options) {
    if (!trace::available())
        throw UsageError(
            "trace: this vtm was built without potrace; configure with -DVTM_WITH_POTRACE=ON "
            "(libpotrace-dev)");
    const bool isSvg = endsWith(options.output, ".svg");
    if (!isSvg && !endsWith(options.output, ".vtm"))
        throw UsageError("trace: " + options.output + " ends neither in .svg nor in .vtm");
    const PictureLimits limits(options.input, true);
    try {
        const scene::Scene scene = trace::trace(image::decode(image::readFile(options.input)), options.trace);
        if (isSvg) {
            const std::string text = svg::write(scene);
            image::writeFile(options.output,
                             {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
        } else {
            image::writeFile(options.output, asset::write(compiler::compile(scene, options.compiler).asset));
        }
    } catch (...) {
        fmt::print(stderr, "{}\n", describeError(options.input));
        return badInput;
    }
    return done;
}

}  // namespace

void addTrace(CLI::App& app, int& exitCode) {
    const auto options = std::make_shared<TraceOptions>();
    CLI::App* command = app.add_subcommand("trace", "Turn a bitmap into an SVG or a .vtm file");
    command->add_option("IN", options->input, "PNG, JPEG, WebP or GIF file")->required();
    command->add_option("-o,--output", options->output, "The .svg or .vtm file")->required();
    command->add_option("--colors", options->trace.colors, "Colours at most")
        ->check(CLI::Range(1, 256))
        ->capture_default_str();
    command->add_option("--speckle", options->trace.speckle, "Leave out spots of so many pixels")
        ->check(CLI::Range(0, 1000000))
        ->capture_default_str();
    command->add_option("--smooth", options->trace.smooth, "From 0, polygons, to 1.3334, no corners")
        ->check(CLI::Range(0.0, 1.3334))
        ->capture_default_str();
    command
        ->add_option("--tolerance", options->compiler.tolerance, "Of the .vtm, as a share of its longer side")
        ->check(CLI::Range(0x1p-26, 0x1p-6));
    command->callback([options, &exitCode] { exitCode = run(*options); });
}

}  // namespace vtm::tools
