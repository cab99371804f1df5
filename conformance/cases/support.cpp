#include "conformance/cases/support.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fmt/core.h>

#include <vtm/compiler/view.hpp>
#include <vtm/image/codec.hpp>
#include <vtm/svg/load.hpp>

namespace vtm::cases {

namespace fs = std::filesystem;

namespace {

std::vector<std::string> columns(const std::string& line) {
    std::vector<std::string> result;
    std::istringstream stream(line);
    for (std::string column; std::getline(stream, column, '\t');)
        result.push_back(column);
    result.resize(6);
    return result;
}

CorpusFile corpusFile(const std::vector<std::string>& column) {
    CorpusFile file{column[0], {}, column[5]};
    if (column[1] != "-")
        file.limits = {{1024, std::stod(column[1]), std::stod(column[2])},
                       {64, std::stod(column[3]), std::stod(column[4])}};
    return file;
}

}  // namespace

fs::path sharedDirectory() {
    const char* shared = std::getenv("VTM_SHARED");
    return shared != nullptr ? fs::path(shared) : fs::path(VTM_SOURCE_DIR) / "../shared";
}

fs::path examplesDirectory() { return fs::path(VTM_SOURCE_DIR) / "examples"; }

scene::Scene loadScene(const fs::path& path) {
    svg::Options options;
    options.fileName = path.string();
    options.resourceDirectory = path.parent_path().string();
    return svg::load(image::readFile(path.string()), options).scene;
}

asset::View wholePicture(const scene::Scene& scene, int size) {
    return compiler::viewOf(scene::frame({.width = size}, scene.width, scene.height));
}

image::Raster asWritten(const image::Raster& raster) { return image::toRaster(image::toBitmap(raster)); }

double CorpusFile::Limit::mean() const { return std::max(best / 3, 3 * floor); }

std::vector<CorpusFile> corpusFiles() {
    const fs::path path = fs::path(VTM_SOURCE_DIR) / "conformance/cases/limits.tsv";
    std::ifstream table(path);
    if (!table)
        throw std::runtime_error(path.string() + ": cannot be read");
    std::vector<CorpusFile> files;
    for (std::string line; std::getline(table, line);)
        if (!line.empty() && line[0] != '#')
            files.push_back(corpusFile(columns(line)));
    return files;
}

scene::Scene sceneOf(const scene::Path& path, scene::FillRule rule, double side) {
    scene::Item item;
    item.path = std::make_shared<scene::Path>(path);
    item.geometry = rule;
    item.paint = scene::Color{0, 0, 0, 1};
    scene::Scene scene;
    scene.width = scene.height = side;
    scene.root.children.push_back({item});
    return scene;
}

Measurement::Measurement(const std::string& name)
    : scene_(loadScene(sharedDirectory() / "corpus" / (name + ".svg"))),
      asset_(compiler::compile(scene_, {.filterPixels = 1024}).asset) {}

image::Raster truthOf(const std::string& name, int size) {
    return compare::readPng((sharedDirectory() / fmt::format("corpus/truth/{}.{}.png", name, size)).string());
}

}  // namespace vtm::cases
