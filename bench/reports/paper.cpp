// Rows 9 to 11 of the paper: docs/paper.md.

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>

#include <fmt/core.h>

#include <vtm/gl/context.hpp>
#include <vtm/image/codec.hpp>
#include "bench/measure/measure.hpp"
#include "bench/measure/shader_count.hpp"
#include "bench/reports/reports.hpp"
#include "paper/compile.hpp"
#include "paper/gl/pattern.hpp"

namespace vtm::bench {
namespace {

using paper::Pattern;
using paper::PatternForm;

/// A tile of n × n stars with bent sides, as one mask.
paper::CompileResult stars(int n, unsigned depth) {
    scene::Path path;
    for (int star = 0; star < n * n; ++star) {
        const scene::Point middle(16 + 32 * (star % n), 16 + 32 * (star / n));
        const auto corner = [&](int i) {
            const double angle = 0.62832 * i + star, radius = i % 2 == 0 ? 14 : 6;
            return radius * scene::Point(std::cos(angle), std::sin(angle));
        };
        path.push_back(scene::MoveTo{middle + corner(0)});
        for (int i = 1; i <= 10; ++i)
            path.push_back(scene::QuadTo{middle + 0.55 * (corner(i - 1) + corner(i)), middle + corner(i)});
        path.push_back(scene::Close{});
    }
    scene::Scene scene{32.0 * n, 32.0 * n, {}};
    scene.root.children.push_back(
        {scene::Item{std::make_shared<const scene::Path>(std::move(path)), scene::identity,
                     scene::FillRule::NonZero, scene::Color{}, 1}});
    return paper::compile(scene, {1.0 / 4096, depth, 6});
}

/// Levels of nodes as the paper's.
constexpr int paperDepth = 2;
/// Functions of a cell that has a corner.
constexpr int functions = 2;

void addCount(Report& report, const std::string& step, const ShaderCost& cost, const std::string& paper) {
    report.rows.push_back({{"what", "count"},
                           {"step", step},
                           {"texture lookups", cost.textures},
                           {"instructions", cost.instructions},
                           {"paper", paper}});
    report.summary.push_back({{"row", step},
                              {"ours", fmt::format("{} tex, {} instr", cost.textures, cost.instructions)},
                              {"paper", paper}});
}

/// Counts, path by path; false without the compiler.
bool count(Report& report) {
    const auto counted = [](paper::PatternForm form) {
        return countShader(paper::patternShader(form, paperDepth));
    };
    const auto plain = counted({false, false, false}), linear = counted({false, false, true}),
               filtered = counted({false, true, false}), compressed = counted({true, false, false}),
               both = counted({true, true, false});
    if (!plain || !linear || !filtered || !compressed || !both)
        return false;
    const std::map<std::string, int> none{{"combined", 0}}, all{{"combined", functions}};
    const std::map<std::string, int> unmipped{{"combined", functions}, {"minified", 0}};
    const std::map<std::string, int> deep{{"combined", functions}, {"descend", paperDepth}};
    const ShaderCost lookup = plain->cost("main", all);
    addCount(report, "9: early out, a square without boundary", plain->cost("main", none), "8 instr");
    addCount(report, "10: lookup, two functions", lookup, "4 tex, 73 instr");
    addCount(report, "10: ... linear only", linear->cost("main", all), "4 tex, 45 instr");
    addCount(report, "6: antialiasing adds", filtered->cost("main", unmipped) - lookup, "0 tex, 6 instr");
    addCount(report, "7: the mip adds", filtered->cost("main", all) - filtered->cost("main", unmipped),
             "1 tex, 7 instr");
    addCount(report, "10: total, filtered", filtered->cost("main", all), "5 tex, 86 instr");
    addCount(report, fmt::format("8: compression adds, {} levels", paperDepth),
             compressed->cost("main", deep) - lookup, "3 tex, 22 instr");
    addCount(report, "filtered and compressed", both->cost("main", deep), "8 tex, 108 instr");
    return true;
}

struct Form {
    const char* name;
    paper::PatternForm form;
    const char* paper;  ///< over the first
};
constexpr std::array forms{Form{"unfiltered, uncompressed", {false, false, false}, "1"},
                           Form{"filtered, uncompressed", {false, true, false}, "1.17"},
                           Form{"unfiltered, compressed", {true, false, false}, "1.07"},
                           Form{"filtered, compressed", {true, true, false}, "1.245"}};

/// Periods along the raster, turned a little more in every round.
asset::View viewOf(int side, double periods, int round) {
    const double scale = side / periods, angle = 0.1 + 0.02 * round;
    const double c = scale * std::cos(angle), s = scale * std::sin(angle);
    return {side, side, {c, s, -s, c, 0.3 * side, 0.1 * side}};
}

constexpr int manyRounds = 80, quickRounds = 24;

void timeForms(const std::string& tile, const paper::CompileResult& compiled, const Options& options,
               Report& report) {
    const int side = options.side;
    const paper::Mask& mask = compiled.asset.masks.at(0);
    report.text += fmt::format("\n\nTile \"{}\": {} cells, of which {} would need more than two functions.",
                               tile, mask.cells.size(), compiled.approximatedCells());
    std::vector<std::unique_ptr<paper::Pattern>> patterns;
    for (const Form& form : forms) {
        patterns.push_back(std::make_unique<paper::Pattern>(mask, form.form));
        if (options.pictures.empty())
            continue;
        std::filesystem::create_directories(options.pictures);
        image::writeFile(fmt::format("{}/{}, {}.png", options.pictures, tile, form.name),
                         image::encodePng(image::toBitmap(patterns.back()->render(viewOf(side, 4, 0)))));
    }
    const int rounds = options.quick ? quickRounds : manyRounds;
    for (const double periods : {1.0, 4.0, 11.0, 64.0}) {
        std::array<std::vector<double>, forms.size()> times, ratios;
        for (int round = -1; round < rounds; ++round) {  // the first is not counted
            std::array<double, forms.size()> once{};
            for (std::size_t turn = 0; turn < forms.size(); ++turn) {
                const std::size_t i = (turn + std::size_t(round + 1)) % forms.size();
                once[i] = cpuTime([&] { patterns[i]->draw(viewOf(side, periods, round)); });
            }
            for (std::size_t i = 0; i < forms.size() && round >= 0; ++i) {
                times[i].push_back(once[i]);
                ratios[i].push_back(once[i] / once[0]);
            }
        }
        for (std::size_t i = 0; i < forms.size(); ++i) {
            const double ratio = median(ratios[i]), low = quantile(ratios[i], 0.25),
                         high = quantile(ratios[i], 0.75);
            const auto bytes = double(patterns[i]->bytes());
            report.rows.push_back({{"what", "time"},
                                   {"form", forms[i].name},
                                   {"tile", tile},
                                   {"periods", periods},
                                   {"side", side},
                                   {"ms", median(times[i])},
                                   {"ratio", ratio},
                                   {"low", low},
                                   {"high", high},
                                   {"bytes", bytes},
                                   {"paper", forms[i].paper}});
            report.summary.push_back(
                {{"row", fmt::format("11: {}, {} x {} periods, {}", tile, periods, periods, forms[i].name)},
                 {"ours", fmt::format("{:.3f} ({:.3f}-{:.3f}); {:.3g} ms; {:.0f} KB", ratio, low, high,
                                      median(times[i]), bytes / 1024)},
                 {"paper", forms[i].paper}});
        }
    }
}

}  // namespace

Report paper(const Options& options) {
    Report report;
    report.name = "paper";
    report.title = "The paper's lookup: rows 9 to 11";
    report.text = fmt::format(
        "One mask, a tile of stars, repeated over {0} × {0} pixels by `paper::Pattern`. Rows 6 to 10: "
        "texture lookups and "
        "instructions in the SPIR-V of its fragment shader as `glslangValidator` writes it, step by step "
        "(loads, stores and "
        "swizzles not counted, a vector operation counted once, both sides of every branch). Row 11: CPU "
        "time of a "
        "frame as a ratio to the unfiltered, uncompressed form in the same round, median and quartiles of "
        "{1} rounds in which "
        "the pattern turns; then milliseconds, and bytes of the textures. Filtered forms are drawn from the "
        "cells up to 8 "
        "periods here, from the mip alone beyond 16, from both between.",
        options.side, options.quick ? quickRounds : manyRounds);
    if (!count(report))
        report.notes.push_back(
            "glslangValidator (Debian: glslang-tools) is not installed: nothing is counted");
    const gl::Context context;
    timeForms("a star, 2 levels", stars(1, paperDepth), options, report);
    timeForms("nine stars, 3 levels", stars(3, 3), options, report);
    report.text += "\n\nDrawn on " + context.renderer() + ", " + context.version() + ".";
    return report;
}

}  // namespace vtm::bench
