#include "bench/src/files.hpp"

#include <algorithm>
#include <cstdlib>

#include <fmt/core.h>

#include "image/codec.hpp"
#include "svg/load.hpp"

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

}  // namespace

std::vector<File> exampleFiles() { return svgFilesIn(fs::path(VTM_SOURCE_DIR) / "examples"); }

std::vector<File> corpusFiles() {
    const char* given = std::getenv("VTM_SHARED");
    const fs::path corpus = (given ? fs::path(given) : fs::path(VTM_SOURCE_DIR) / "../shared") / "corpus";
    if (fs::exists(corpus))
        return svgFilesIn(corpus);
    fmt::print(stderr, "skipped: the corpus, which is not in {}\n", corpus.string());
    return {};
}

scene::Scene load(const File& file) {
    svg::Options options;
    options.fileName = file.path.string();
    options.resourceDirectory = file.path.parent_path().string();
    return svg::load(image::readFile(file.path.string()), options).scene;
}

}  // namespace vtm::bench
