#include "bench/input/files.hpp"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <string_view>

#include <fmt/core.h>

#include <vtm/image/codec.hpp>
#include <vtm/svg/load.hpp>

namespace vtm::bench {
namespace {

namespace fs = std::filesystem;

std::vector<File> svgFilesIn(const fs::path& folder) {
    std::vector<File> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".svg")
            files.push_back({entry.path().stem().string(), entry.path()});
    std::ranges::sort(files, {}, &File::name);
    return files;
}

std::vector<File> exampleFiles() { return svgFilesIn(fs::path(VTM_SOURCE_DIR) / "examples"); }

std::vector<File> corpusFiles() {
    const fs::path corpus = sharedFolder() / "corpus";
    if (fs::exists(corpus))
        return svgFilesIn(corpus);
    fmt::print(stderr, "skipped: the corpus, which is not in {}\n", corpus.string());
    return {};
}

/// Strokes, gradients, small detail, abutting shapes, large curves.
bool isQuick(const File& file) {
    static constexpr std::string_view quick[] = {"lighthouse",  "rose_window", "tree", "counties",
                                                 "noto_people", "tiger",       "world"};
    return std::ranges::find(quick, file.name) != std::end(quick);
}

std::vector<File> allFiles(const Options& options) {
    std::vector<File> files;
    for (const fs::path path : options.files)
        files.push_back({path.stem().string(), path});
    if (!files.empty())
        return files;
    files = exampleFiles();
    if (!options.examples)
        std::ranges::copy(corpusFiles(), std::back_inserter(files));
    return files;
}

}  // namespace

fs::path sharedFolder() {
    const char* given = std::getenv("VTM_SHARED");
    return given ? fs::path(given) : fs::path(VTM_SOURCE_DIR) / "../shared";
}

std::vector<File> filesOf(const Options& options) {
    std::vector<File> files = allFiles(options);
    if (!options.only.empty())
        std::erase_if(files, [&](const File& file) { return file.name != options.only; });
    else if (options.quick && options.files.empty())
        std::erase_if(files, [](const File& file) { return !isQuick(file); });
    return files;
}

std::vector<File> oneFileOf(const Options& options) {
    const std::vector<File> files = allFiles(options);
    for (const std::string_view name :
         {std::string_view(options.only), std::string_view("tiger"), std::string_view("lighthouse")})
        if (const auto file = std::ranges::find(files, name, &File::name); file != files.end())
            return {*file};
        else if (name == options.only && !name.empty())
            break;
    return {};
}

scene::Scene load(const File& file) {
    svg::Options options;
    options.fileName = file.path.string();
    options.resourceDirectory = file.path.parent_path().string();
    return svg::load(image::readFile(file.path.string()), options).scene;
}

asset::View wholePicture(const scene::Scene& scene, int side) {
    const double scale = side / std::max(scene.width, scene.height);
    return {std::max(1, int(scale * scene.width + 0.5)),
            std::max(1, int(scale * scene.height + 0.5)),
            {scale, 0, 0, scale, 0, 0}};
}

}  // namespace vtm::bench
