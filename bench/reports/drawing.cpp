#include <algorithm>

#include <fmt/core.h>

#include "bench/engines/contest.hpp"
#include "bench/measure/measure.hpp"

namespace vtm::bench {
namespace {

constexpr Kind kinds[] = {{.name = "cold", .moving = false, .cold = true},
                          {.name = "unchanged", .moving = false},
                          {.name = "turning"},
                          {.name = "turning at 8x", .zoom = 8},
                          {.name = "zoom path", .zooming = true},
                          {.name = "minified", .size = 1.0 / 16}};

struct Ratio {
    double median, low, high;
};

/// How often `first` fits into `second`, round by round.
Ratio ratioOf(const std::vector<double>& second, const std::vector<double>& first) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < std::min(first.size(), second.size()); ++i)
        ratios.push_back(second[i] / first[i]);
    return {median(ratios), quantile(ratios, 0.25), quantile(ratios, 0.75)};
}

std::string cell(const Contender& one, const Contender& against) {
    if (one.times.empty())
        return "-";
    const std::string time = fmt::format("{:.3g}", median(one.times));
    if (one.ours)
        return time;
    const Ratio ratio = ratioOf(one.times, against.times);
    return fmt::format("{} ({:.3g}: {:.3g}-{:.3g}){}", time, ratio.median, ratio.low, ratio.high,
                       one.difference > otherPicture ? " ≠" : "");
}

void addRows(const Contenders& all, const LoadedFile& picture, const Kind& kind, int side, Report& report) {
    Json line = {{"file", picture.file.name}, {"views", kind.name}};
    for (const Contender& one : all) {
        line[one.engine->name()] = cell(one, reference(all));
        if (one.times.empty())
            continue;
        Json ratios = Json::object();
        for (const Contender& ours : all)
            if (ours.ours) {
                const Ratio ratio = ratioOf(one.times, ours.times);
                ratios[ours.engine->name()] = {
                    {"median", ratio.median}, {"low", ratio.low}, {"high", ratio.high}};
            }
        report.rows.push_back({{"file", picture.file.name},
                               {"views", kind.name},
                               {"side", side},
                               {"engine", one.engine->name()},
                               {"ms", median(one.times)},
                               {"rounds", one.times.size()},
                               {"rms from ours", one.difference},
                               {"ratios", ratios}});
    }
    report.summary.push_back(line);
}

/// Over the files: the median of each engine's ratios.
void addMedians(const Contenders& all, Report& report) {
    const std::string against = reference(all).engine->name();
    for (const Kind& kind : kinds) {
        Json line = {{"file", "median of the ratios"}, {"views", kind.name}};
        for (const Contender& one : all) {
            std::vector<double> ratios;
            for (const Json& row : report.rows)
                if (row["views"] == kind.name && row["engine"] == one.engine->name() &&
                    row["ratios"].contains(against) && row["rms from ours"] <= otherPicture)
                    ratios.push_back(row["ratios"][against]["median"]);
            line[one.engine->name()] = ratios.empty() ? "-" : fmt::format("{:.3g}", median(ratios));
        }
        report.summary.push_back(line);
    }
}

}  // namespace

Report drawing(const Options& options) {
    Report report;
    report.name = options.side == 1024 ? "drawing" : fmt::format("drawing_{}", options.side);
    report.title = fmt::format("Drawing at {} pixels", options.side);
    Contenders all = contenders(options, report.notes);
    report.text = fmt::format(
        "CPU milliseconds of one drawing on one processor, medians, all taking turns in one run; in brackets "
        "how many times as long as `{}`, round by round: median and quartiles. ≠ marks a "
        "picture that differs from ours by more than {} of 255 (rms of means over 64ths of the side). "
        "Turning: rotation and zoom change with every drawing, everything prepared before. Zoom path: from "
        "1/16 to "
        "64 times, doubled with every drawing. Minified: turning, on a raster of a sixteenth of the side. "
        "Cold: "
        "from the file to pixels.\n",
        reference(all).engine->name(), otherPicture);
    for (const Contender& one : all)
        report.text += fmt::format("\n- `{}`: {}", one.engine->name(), one.engine->description());
    report.text += "\n";
    for (const File& file : filesOf(options)) {
        fmt::print(stderr, "{}\n", file.name);
        const LoadedFile picture{file, load(file)};
        prepare(all, picture, kinds, options, report.notes);
        for (const Kind& kind : kinds) {
            takeTurns(all, picture, kind, options.side, patienceOf(options), report.notes);
            addRows(all, picture, kind, options.side, report);
        }
    }
    addMedians(all, report);
    return report;
}

}  // namespace vtm::bench
