#include <algorithm>
#include <filesystem>

#include <fmt/core.h>

#include <vtm/compiler/view.hpp>
#include "bench/engines/contest.hpp"
#include "bench/measure/measure.hpp"
#include "conformance/compare/compare.hpp"
#include "conformance/reference/reference.hpp"

namespace vtm::bench {
namespace {

constexpr int truthSides[] = {1024, 64};  ///< those of the ground truth

/// Points a side of a pixel where paints vary: our drawings' gradients are smooth.
constexpr int referenceSamples = 4;

struct Truth {
    image::Raster raster;
    const char* source;
};

asset::View wholePicture(const scene::Scene& scene, int width) {
    return compiler::viewOf(scene::frame({.width = width}, scene.width, scene.height));
}

/// Another engine's, averaged over many samples, where the corpus has one; else our exact reference.
Truth truthOf(const LoadedFile& picture, const asset::View& view) {
    const std::filesystem::path known =
        sharedFolder() / "corpus" / "truth" / fmt::format("{}.{}.png", picture.file.name, view.width);
    if (std::filesystem::exists(known))
        return {compare::readPng(known.string()), "corpus"};
    return {reference::render(picture.scene, {view.width, view.height, view.toPixels},
                              {.samples = referenceSamples}),
            "reference"};
}

void addErrors(Contenders& all, const LoadedFile& picture, int side, Report& report) {
    const asset::View view = wholePicture(picture.scene, side);
    const Truth truth = truthOf(picture, view);
    Json line = {{"file", picture.file.name}, {"px", side}, {"truth", truth.source}};
    for (Contender& one : all) {
        line[one.engine->name()] = "-";
        try {
            one.engine->load(picture);
            const compare::Difference d =
                compare::compare(image::toRaster(one.engine->pixels(view)), truth.raster);
            line[one.engine->name()] = fmt::format("{:.3f} / {:.0f}", d.mean, d.p999);
            report.rows.push_back({{"file", picture.file.name},
                                   {"px", side},
                                   {"truth", truth.source},
                                   {"engine", one.engine->name()},
                                   {"mean", d.mean},
                                   {"p99.9", d.p999},
                                   {"max", d.max}});
        } catch (const std::exception& refusal) {
            const std::string note =
                fmt::format("{}: not by {}: {}.", picture.file.name, one.engine->name(), refusal.what());
            if (std::ranges::find(report.notes, note) == report.notes.end())
                report.notes.push_back(note);
        }
    }
    report.summary.push_back(line);
}

/// Over the files that an engine draws.
void addMedianErrors(const Contenders& all, Report& report) {
    for (const int side : truthSides) {
        Json line = {{"file", "median"}, {"px", side}, {"truth", ""}};
        for (const Contender& one : all) {
            std::vector<double> means, tails;
            for (const Json& row : report.rows)
                if (row["px"] == side && row["engine"] == one.engine->name()) {
                    means.push_back(row["mean"]);
                    tails.push_back(row["p99.9"]);
                }
            line[one.engine->name()] =
                means.empty() ? "-" : fmt::format("{:.3f} / {:.0f}", median(means), median(tails));
        }
        report.summary.push_back(line);
    }
}

}  // namespace

Report error(const Options& options) {
    Report report;
    report.name = "error";
    report.title = "Error against exact truth";
    report.text =
        "Of each engine's 8-bit picture: mean absolute difference of premultiplied channels and 99.9th "
        "percentile, "
        "in 255ths. The truth is the corpus's where it has one (16 × 16 anti-aliased samples a pixel of "
        "another "
        "engine, or 48 × 48 points), else our exact reference, which shares nothing with the compiler. "
        "Medians are "
        "over the files that an engine draws.";
    Contenders all = contenders(options, report.notes);
    for (const File& file : filesOf(options)) {
        fmt::print(stderr, "{}\n", file.name);
        const LoadedFile picture{file, load(file)};
        for (const int side : truthSides)
            addErrors(all, picture, side, report);
    }
    addMedianErrors(all, report);
    return report;
}

}  // namespace vtm::bench
