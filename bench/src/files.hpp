/// \file
/// The pictures that are measured.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace vtm::bench {

struct File {
    std::string name;
    std::filesystem::path path;
};

/// Our own drawings.
std::vector<File> exampleFiles();
/// The real pictures in $VTM_SHARED/corpus, or shared/corpus beside the checkout; none where it is absent,
/// which is said on stderr.
std::vector<File> corpusFiles();

scene::Scene load(const File& file);

}  // namespace vtm::bench
