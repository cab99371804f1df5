// Pictures with filters, from the file to pixels.

#include <unistd.h>

#include <filesystem>
#include <span>

#include <fmt/core.h>

#include "bench/input/filter_pictures.hpp"
#include "bench/reports/picture_rows.hpp"

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
        "CPU milliseconds (user and system) on one processor from the file to pixels, {} wide, medians, all "
        "taking turns in one run; in brackets how many times as long as `{}`. The first pictures are one "
        "drawing of 512 units with one filter each. On software drivers `gl` computes filters on the CPU, "
        "`shaders` by passes. The last two rows are drawn again and do not read the file. Qt draws SVG Tiny, "
        "without filters, and librsvg 2.54 has no feDropShadow: what they draw there is another picture.\n",
        options.side, reference(all).engine->name());
    report.text += descriptionsOf(all);
    const std::vector<File> files = picturesIn(folder, report.notes);
    for (const File& file : files)
        report.rows.push_back(pictureRow(all, {file, load(file)}, cold, "picture", options, report.notes));
    Options small = options;
    small.side = 512;
    for (File file : std::span(files).first(2)) {
        file.name += ", drawn again, 512 wide";
        report.rows.push_back(pictureRow(all, {file, load(file)}, again, "picture", small, report.notes));
    }
    fs::remove_all(folder);
    removeEmptyColumns(all, report.rows);
    return report;
}

}  // namespace vtm::bench
