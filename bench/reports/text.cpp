// Pages of text, from the file to pixels.

#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include <fmt/core.h>

#include <vtm/compiler/compile.hpp>
#include "bench/engines/contest.hpp"
#include "bench/input/text_pages.hpp"
#include "bench/measure/measure.hpp"

namespace vtm::bench {
namespace {

namespace fs = std::filesystem;

constexpr Kind cold{.name = "cold", .moving = false, .cold = true};

constexpr const char* absent = "-";

/// Engines that are given paths alone read no file.
void removeEmptyColumns(const Contenders& all, Json& rows) {
    for (const Contender& one : all) {
        const std::string& name = one.engine->name();
        if (std::ranges::all_of(rows, [&](const Json& row) { return row[name] == absent; }))
            for (Json& row : rows)
                row.erase(name);
    }
}

/// What stands before the outlines: XML, styles, shaping, layout.
double loadMilliseconds(const File& file) {
    std::vector<double> times;
    for (int i = 0; i < 5; ++i)
        times.push_back(cpuTime([&] { load(file); }));
    return median(times);
}

Json rowOf(const Contenders& all, const CompiledFile& page) {
    Json row{{"page", page.file.name}};
    const double ours = median(reference(all).times);
    for (const Contender& one : all) {
        const double time = median(one.times);
        row[one.engine->name()] = one.times.empty() ? absent
                                  : one.ours        ? fmt::format("{:.3g}", time)
                                                    : fmt::format("{:.3g} ({:.3g})", time, time / ours);
    }
    row["of ours: to the scene"] = loadMilliseconds(page.file);
    return row;
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
        "CPU milliseconds (user and system, all threads) from the file to pixels, {} wide, medians, all "
        "taking "
        "turns in one run after a first round that is not counted, so that fontconfig's caches are warm; in "
        "brackets how many times as long as `{}`. A page has 50 lines of 100 characters. The last column is "
        "the part of ours that reads, shapes and lays out the text. resvg lists the system's fonts for every "
        "picture anew.\n",
        options.side, reference(all).engine->name());
    for (const Contender& one : all)
        report.text += fmt::format("\n- `{}`: {}", one.engine->name(), one.engine->description());
    report.text += "\n";
    for (const File& file : writeTextPages(folder, report.notes)) {
        CompiledFile page{file, load(file), {}};
        page.asset = compiler::compile(page.scene).asset;
        prepare(all, page, {&cold, 1}, options, report.notes);
        takeTurns(all, page, cold, options.side, patienceOf(options), report.notes);
        report.rows.push_back(rowOf(all, page));
    }
    fs::remove_all(folder);
    removeEmptyColumns(all, report.rows);
    return report;
}

}  // namespace vtm::bench
