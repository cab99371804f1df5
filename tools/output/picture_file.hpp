/// \file
/// The file that a picture becomes: its format, what the format has, writing it.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <vtm/image/encode.hpp>
#include "image/pixel_writer.hpp"

namespace vtm::tools {

struct FileOptions {
    std::optional<image::FileFormat> format;  ///< --format
    image::EncodeOptions encoding;
};

/// With its dot, for names that are made.
std::string suffixFor(const FileOptions& options);

/// By the name's suffix; where it has none, and for devices and standard output, --format, else PNG. Throws
/// UsageError for another suffix, for one that --format contradicts, and for options that the format does not
/// have.
image::FileFormat formatOf(const std::string& output, const FileOptions& options);

/// Takes the rows of a picture, then writes the file, into a folder that is made if it is missing.
class PictureFile {
public:
    PictureFile(const std::string& output, const FileOptions& options, int width, int height);

    image::RowSink sink();
    /// Throws image::CodecError, StandardOutputError.
    void write();
    /// Encoding and writing so far.
    double milliseconds() const { return milliseconds_; }

private:
    std::string output_;
    std::unique_ptr<image::Encoder> encoder_;
    double milliseconds_ = 0;
};

}  // namespace vtm::tools
