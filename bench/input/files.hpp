/// \file
/// The pictures that are measured.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <vtm/raster/view.hpp>
#include <vtm/scene/scene.hpp>
#include "bench/measure/options.hpp"

namespace vtm::bench {

struct File {
    std::string name;
    std::filesystem::path path;
};

/// Those that are named; else our own drawings, and the real pictures in $VTM_SHARED/corpus, or shared/corpus
/// beside the checkout; where that is absent is said on stderr. A few of both in a quick run.
std::vector<File> filesOf(const Options& options);

/// The one of these that is asked for; else the Tiger, or the lighthouse where the corpus is absent. Nothing
/// if there is no such file.
std::vector<File> oneFileOf(const Options& options);

/// $VTM_SHARED, or shared beside the checkout; perhaps absent.
std::filesystem::path sharedFolder();

scene::Scene load(const File& file);

/// All of a picture, `side` pixels along its longer side.
asset::View wholePicture(const scene::Scene& scene, int side);

}  // namespace vtm::bench
