/// \file
/// Pages of text as SVG files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/input/files.hpp"

namespace vtm::bench {

/// Pages of some 5000 characters in Debian's fonts: Latin in three families, each character placed by itself,
/// Arabic, Chinese. The same on every machine. Written into the folder; pages whose fonts are not installed
/// are noted instead.
std::vector<File> writeTextPages(const std::filesystem::path& folder, std::vector<std::string>& notes);

}  // namespace vtm::bench
