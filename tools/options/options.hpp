/// \file
/// Options that subcommands share: each function adds a group of them to a subcommand. What is typed is
/// checked when it is parsed; UsageError or CLI11's own errors say what is wrong.
#pragma once

#include <string>

#include <vtm/scene/fit.hpp>
#include <vtm/scene/paint.hpp>
#include "tools/input/source.hpp"
#include "tools/output/picture_file.hpp"

namespace CLI {
class App;
}

namespace vtm::tools {

/// --width, --height, --zoom, --fit, --view, --rotate: how large the raster is and what of the picture it
/// shows.
void addFramingOptions(CLI::App& command, scene::Framing& framing);

/// --format, --depth, --quality.
void addFileOptions(CLI::App& command, FileOptions& options);

/// --strict and what the importer needs: fonts, dpi, language.
void addImportOptions(CLI::App& command, SourceOptions& options);

/// --mode, --tolerance and those of addImportOptions().
void addSourceOptions(CLI::App& command, SourceOptions& options);

/// --export-id, whose use `description` says.
void addExportId(CLI::App& command, std::string& id, const std::string& description);

/// --max-seconds and --max-memory. They hold for the whole run.
void addLimitOptions(CLI::App& command);

/// Any colour that SVG knows. Throws UsageError.
scene::Color parseColor(const std::string& text);

}  // namespace vtm::tools
