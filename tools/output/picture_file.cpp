#include "tools/output/picture_file.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

#include <fmt/format.h>

#include "tools/input/input.hpp"
#include "tools/output/output.hpp"
#include "tools/process/errors.hpp"
#include "tools/process/stages.hpp"

namespace vtm::tools {

namespace {

namespace fs = std::filesystem;
using image::FileFormat;

struct Known {
    FileFormat format;
    const char *name, *suffix;
};
constexpr std::array<Known, 4> known{{{FileFormat::Png, "png", ".png"},
                                      {FileFormat::Jpeg, "jpeg", ".jpg"},
                                      {FileFormat::Webp, "webp", ".webp"},
                                      {FileFormat::Ppm, "ppm", ".ppm"}}};

const Known& knownOf(FileFormat format) { return *std::ranges::find(known, format, &Known::format); }

void requireOptions(FileFormat format, const FileOptions& options) {
    const char* const name = knownOf(format).name;
    if (!image::hasDepth(format, options.encoding.depth))
        throw UsageError(fmt::format("--depth {}: {} files do not support it", options.encoding.depth, name));
    if (options.encoding.quality && format != FileFormat::Jpeg && format != FileFormat::Webp)
        throw UsageError(fmt::format("--quality: {} files are lossless", name));
}

}  // namespace

std::string suffixFor(const FileOptions& options) {
    return knownOf(options.format.value_or(FileFormat::Png)).suffix;
}

FileFormat formatOf(const std::string& output, const FileOptions& options) {
    requireSuffix(output, {".png", ".jpg", ".jpeg", ".webp", ".ppm"});
    const auto named = isRegularOutput(output) ? image::formatOfSuffix(suffixOf(output)) : std::nullopt;
    if (named && options.format && *named != *options.format)
        throw UsageError(
            fmt::format("--format {}: contradicts the suffix of {}", knownOf(*options.format).name, output));
    const FileFormat format = named ? *named : options.format.value_or(FileFormat::Png);
    requireOptions(format, options);
    return format;
}

PictureFile::PictureFile(const std::string& output, const FileOptions& options, int width, int height)
    : output_(output),
      encoder_(image::makeEncoder(formatOf(output, options), width, height, options.encoding)) {}

image::RowSink PictureFile::sink() {
    return [this](std::span<const std::uint8_t> row) {
        milliseconds_ += millisecondsOf([&] { encoder_->add(row); });
    };
}

void PictureFile::write() {
    milliseconds_ += millisecondsOf([&] {
        const std::vector<std::uint8_t> bytes = encoder_->finish();
        encoder_.reset();
        if (const fs::path directory = fs::path(output_).parent_path(); !directory.empty())
            fs::create_directories(directory);
        writeOutput(output_, bytes);
    });
}

}  // namespace vtm::tools
