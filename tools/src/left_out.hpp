/// \file
/// Warnings of what is not in the picture, or is there in another form than the file asks for.
#pragma once

#include <string>
#include <vector>

#include <vtm/svg/load.hpp>
#include "tools/src/source.hpp"

namespace vtm::tools {

/// Says that something was left out of the source, and counts it. `message` names the source, and the place
/// if it has one.
void warnOf(Source& source, const std::string& message);

/// The importer's warnings; text and filters together in one line.
void warnOf(Source& source, const std::vector<svg::Warning>& warnings);

/// --strict: throws std::runtime_error if anything was left out.
void refuseLeftOut(const Source& source);

}  // namespace vtm::tools
