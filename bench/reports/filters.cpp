// Pictures with filters, from the file to pixels.

#include <unistd.h>

#include <filesystem>

#include <fmt/core.h>

#include <vtm/compiler/compile.hpp>
#include "bench/input/filter_pictures.hpp"
#include "bench/reports/cold_rows.hpp"

namespace vtm::bench {
namespace {

namespace fs = std::filesystem;

/// Ours, and the pictures of the corpus that are made of filters.
std::vector<File> picturesIn(const fs::path& folder, std::vector<std::string>& notes) {
    std::vector<File> files = writeFilterPictures(folder);
    for (const char* name : {"fluent_prince", "gallardo"})
        if (const fs::path path = sharedFolder() / "corpus" / (std::string(name) + ".svg"); fs::exists(path))
            files.push_back({name, path});
        else
            notes.push_back(path.string() + " is absent");
    return files;
}

}  // namespace

Report filters(const Options& options) {
    Report report;
    report.name = "filters";
    report.title = "Filters";
    Contenders all = contenders(options, report.notes);
    const fs::path folder = fs::temp_directory_path() / fmt::format("vtm_bench_filters_{}", getpid());
    fs::create_directories(folder);
    report.text = fmt::format(
        "CPU milliseconds (user and system, all threads) from the file to pixels, {} wide, medians, all "
        "taking "
        "turns in one run; in brackets how many times as long as `{}`. The first pictures are one drawing of "
        "512 "
        "units with one filter each. Filters are computed on the CPU in all of our engines.\n",
        options.side, reference(all).engine->name());
    report.text += descriptionsOf(all);
    for (const File& file : picturesIn(folder, report.notes)) {
        CompiledFile picture{file, load(file), {}};
        picture.asset = compiler::compile(picture.scene).asset;
        report.rows.push_back(coldRow(all, picture, "picture", options, report.notes));
    }
    fs::remove_all(folder);
    removeEmptyColumns(all, report.rows);
    return report;
}

}  // namespace vtm::bench
