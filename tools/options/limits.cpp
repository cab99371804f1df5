#include "tools/process/limits.hpp"

#include <cstdlib>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "tools/options/options.hpp"
#include "tools/process/errors.hpp"

namespace vtm::tools {

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

}  // namespace vtm::tools
