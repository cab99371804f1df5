/// \file
/// Pictures with filters as SVG files.
#pragma once

#include <filesystem>
#include <vector>

#include "bench/input/files.hpp"

namespace vtm::bench {

/// One filter each on the same drawing, 512 units wide. Written into the folder.
std::vector<File> writeFilterPictures(const std::filesystem::path& folder);

}  // namespace vtm::bench
