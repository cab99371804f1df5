// Pages of text, from the file to pixels.

#include <unistd.h>

#include <filesystem>

#include <fmt/core.h>

#include "bench/input/text_pages.hpp"
#include "bench/measure/measure.hpp"
#include "bench/reports/picture_rows.hpp"

namespace vtm::bench {
namespace {

namespace fs = std::filesystem;

/// What stands before the outlines: XML, styles, shaping, layout.
double loadMilliseconds(const File& file) {
    std::vector<double> times;
    for (int i = 0; i < 5; ++i)
        times.push_back(spentTime([&] { load(file); }));
    return median(times);
}

}  // namespace

Report text(const Options& options) {
    Report report;
    report.name = "text";
    report.title = "Pages of text";
    Contenders all = contenders(options, report.notes);
    const fs::path folder = fs::temp_directory_path() / fmt::format("vtm_bench_text_{}", getpid());
    fs::create_directories(folder);
    report.text = fmt::format(
        "CPU milliseconds (user and system) on one processor from the file to pixels, {} wide, medians, all "
        "taking "
        "turns in one run after a first round that is not counted, so that fontconfig's caches are warm; in "
        "brackets how many times as long as `{}`. A page has 50 lines of 100 characters. The last column is "
        "the part of ours that reads, shapes and lays out the text. resvg lists the system's fonts for every "
        "picture anew.\n",
        options.side, reference(all).engine->name());
    report.text += descriptionsOf(all);
    for (const File& file : writeTextPages(folder, report.notes)) {
        const LoadedFile page{file, load(file)};
        Json row = pictureRow(all, page, cold, "page", options, report.notes);
        row["of ours: to the scene"] = loadMilliseconds(page.file);
        report.rows.push_back(std::move(row));
    }
    fs::remove_all(folder);
    removeEmptyColumns(all, report.rows);
    return report;
}

}  // namespace vtm::bench
