/// \file
/// Options for text, which is not drawn yet. Scripts use them already, so they stay.
#pragma once

#include <CLI/CLI.hpp>

#include <vtm/svg/load.hpp>

namespace vtm::tools {

/// Fonts, and what is used already: --default-font-size and --language. A warning names those of the others
/// that were given. A folder of fonts that does not exist is bad usage.
void addTextOptions(CLI::App& command, svg::Options& svg);

}  // namespace vtm::tools
