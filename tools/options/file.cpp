#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "tools/options/options.hpp"
#include "tools/process/errors.hpp"

namespace vtm::tools {

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

}  // namespace vtm::tools
