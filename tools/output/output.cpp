#include "tools/output/output.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>
#include <unistd.h>

#include <vtm/image/codec.hpp>
#include "tools/input/input.hpp"
#include "tools/process/errors.hpp"

namespace vtm::tools {

namespace {

namespace fs = std::filesystem;

/// Device and inode, or the path of what is not there yet. Nothing for devices and pipes: writing to them
/// loses nothing.
struct Identity {
    dev_t device = 0;
    ino_t inode = 0;
    std::string path;
    auto operator<=>(const Identity&) const = default;
};

std::optional<Identity> identityOf(const struct stat& status) {
    return S_ISREG(status.st_mode) ? std::optional(Identity{status.st_dev, status.st_ino, ""}) : std::nullopt;
}

std::optional<Identity> identityOf(int descriptor) {
    struct stat status {};
    return fstat(descriptor, &status) == 0 ? identityOf(status) : std::nullopt;
}

std::optional<Identity> identityOf(const std::string& path) {
    struct stat status {};
    if (stat(path.c_str(), &status) == 0)
        return identityOf(status);
    std::error_code unknown;
    return Identity{0, 0, fs::weakly_canonical(fs::absolute(path, unknown), unknown).string()};
}

std::optional<Identity> identityOfInput(const std::string& input) {
    return input == standardStream ? identityOf(STDIN_FILENO) : identityOf(input);
}

std::optional<Identity> identityOfOutput(const std::string& output) {
    return isStandardOutput(output) ? identityOf(STDOUT_FILENO) : identityOf(output);
}

bool isDeviceOrPipe(const std::string& path) {
    struct stat status {};
    return stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode);
}

}  // namespace

bool isStandardOutput(const std::string& output) {
    return output == standardStream || output == "/dev/stdout";
}

bool isRegularOutput(const std::string& output) {
    return !isStandardOutput(output) && !isDeviceOrPipe(output);
}

void requireSuffix(const std::string& output, std::initializer_list<std::string_view> suffixes) {
    const std::string suffix = suffixOf(output);
    if (suffix.empty() || std::ranges::find(suffixes, suffix) != suffixes.end() || isDeviceOrPipe(output))
        return;
    throw UsageError(fmt::format("-o: {} does not end in {}", output, fmt::join(suffixes, " or ")));
}

void refuseLoss(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs) {
    if (std::ranges::count(inputs, standardStream) > 1)
        throw UsageError("more than one input is standard input");
    std::map<Identity, std::string> read, written;
    for (const std::string& input : inputs)
        if (const auto identity = identityOfInput(input))
            read.emplace(*identity, nameOf(input));
    if (std::ranges::count_if(outputs, isStandardOutput) > 1)
        throw UsageError("-o: more than one result would be written to standard output");
    if (std::ranges::count(outputs, "") > 0)
        throw UsageError("-o: the name is empty");
    for (const std::string& output : outputs) {
        if (isStandardOutput(output) && standardOutputIsTerminal())
            throw UsageError("-o: standard output is a terminal");
        const auto identity = identityOfOutput(output);
        if (!identity)
            continue;
        if (const auto found = read.find(*identity); found != read.end())
            throw UsageError(
                fmt::format("-o: {} is the input {}, which would be overwritten", output, found->second));
        if (!written.emplace(*identity, output).second)
            throw UsageError(output + ": more than one input would be written there");
    }
}

void refuseMixture(const std::string& output, std::string_view figures) {
    if (isStandardOutput(output))
        throw UsageError(fmt::format("-o {}: {} are also written to standard output", output, figures));
}

void print(std::string_view text) {
    print(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

void print(std::span<const std::uint8_t> bytes) {
    if (const int error = image::writeStream(STDOUT_FILENO, bytes); error != 0)
        throw StandardOutputError(error);
}

bool standardOutputIsTerminal() { return isatty(STDOUT_FILENO) == 1; }

void writeOutput(const std::string& output, std::span<const std::uint8_t> bytes) {
    if (isStandardOutput(output))
        print(bytes);
    else
        image::writeFile(output, bytes);
}

}  // namespace vtm::tools
