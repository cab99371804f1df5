// Rows 5 to 13 of the paper: docs/paper.md.

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>

#include <fmt/core.h>

#include <vtm/asset/container.hpp>
#include <vtm/authoring.hpp>
#include <vtm/font/typesetter.hpp>
#include <vtm/gl/context.hpp>
#include <vtm/gl/text_texture.hpp>
#include <vtm/image/codec.hpp>
#include "bench/measure/measure.hpp"
#include "bench/measure/shader_count.hpp"
#include "bench/reports/reports.hpp"
#include "paper/compile.hpp"
#include "paper/evaluate.hpp"
#include "paper/gl/pattern.hpp"
#include "paper/gl/renderer.hpp"

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
    const auto counted = [](paper::PatternForm form, paper::Shown shown = paper::Shown::View) {
        return countShader(paper::patternShader(form, paperDepth, shown));
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
    const auto alone = counted({false, true, false}, paper::Shown::Surface);
    if (!alone)
        return false;
    addCount(report, "7: ... in perspective, each pixel its level",
             alone->cost("main", all) - filtered->cost("main", unmipped), "1 tex, 7 instr");
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

/// A floor from the lower border of the raster to the horizon at its upper one, of so many periods along its
/// lower border.
paper::Surface floor(double periods) {
    paper::Surface surface;
    for (const double depth : {64.0, 1.0})
        for (const double across : {-depth, depth})
            surface.vertices.push_back(
                {glm::dvec4(across, 2 - depth, 0, depth), 0.5 * periods * glm::dvec2(across, depth)});
    surface.triangles = {0, 1, 2, 2, 1, 3};
    return surface;
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
    const paper::UploadedSurface onFloor(floor(4));
    struct Shown {
        const char* row;
        std::string name;
        std::function<void(Pattern&, int round)> draw;
    };
    std::vector<Shown> all;
    for (const double periods : {1.0, 4.0, 11.0, 64.0})
        all.push_back({"11", fmt::format("{0} x {0} periods", periods),
                       [=](Pattern& pattern, int round) { pattern.draw(viewOf(side, periods, round)); }});
    all.push_back({"12", "a floor to the horizon", [&](Pattern& pattern, int) {
                       pattern.draw(onFloor, {side, side});
                   }});
    for (const Shown& shown : all) {
        std::array<std::vector<double>, forms.size()> times, ratios;
        for (int round = -1; round < rounds; ++round) {  // the first is not counted
            std::array<double, forms.size()> once{};
            for (std::size_t turn = 0; turn < forms.size(); ++turn) {
                const std::size_t i = (turn + std::size_t(round + 1)) % forms.size();
                once[i] = spentTime([&] { shown.draw(*patterns[i], round); });
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
                                   {"shown", shown.name},
                                   {"side", side},
                                   {"ms", median(times[i])},
                                   {"ratio", ratio},
                                   {"low", low},
                                   {"high", high},
                                   {"bytes", bytes},
                                   {"paper", forms[i].paper}});
            report.summary.push_back(
                {{"row", fmt::format("{}: {}, {}, {}", shown.row, tile, shown.name, forms[i].name)},
                 {"ours", fmt::format("{:.3f} ({:.3f}-{:.3f}); {:.3g} ms; {:.0f} KB", ratio, low, high,
                                      median(times[i]), bytes / 1024)},
                 {"paper", forms[i].paper}});
        }
    }
}

// ---- Rows 5 and 13 ----------------------------------------------------------------------------------

/// Figure 7: three VTMs over four gradients, two of them the sides of the third. A sign on a sign.
scene::Scene signOnASign() {
    const auto gradient = [](scene::Color from, scene::Color to, double angle) {
        scene::LinearGradient made;
        made.start = {128 - 120 * std::cos(angle), 128 - 120 * std::sin(angle)};
        made.end = {128 + 120 * std::cos(angle), 128 + 120 * std::sin(angle)};
        made.stops = {{0, from}, {1, to}};
        return Vtm::paint(made);
    };
    const auto disc = [](double radius) {
        const scene::Point left(128 - radius, 128), right(128 + radius, 128);
        return filled(scene::Path{scene::MoveTo{left}, scene::ArcTo{{radius, radius}, 0, false, true, right},
                                  scene::ArcTo{{radius, radius}, 0, false, true, left}, scene::Close{}});
    };
    const Mask arrow = filled(
        scene::polygon({{128, 60}, {176, 120}, {144, 120}, {144, 196}, {112, 196}, {112, 120}, {80, 120}}));
    const Vtm inner = Vtm::select(arrow, gradient({1, 1, 1, 1}, {0.8f, 0.85f, 1, 1}, 1.6),
                                  gradient({0.1f, 0.3f, 0.8f, 1}, {0, 0.1f, 0.4f, 1}, 0.8));
    const Vtm outer = Vtm::select(filled(scene::rectangle({12, 12}, {244, 244})),
                                  gradient({1, 0.9f, 0.2f, 1}, {0.9f, 0.5f, 0, 1}, 0),
                                  gradient({0.3f, 0.5f, 0.3f, 1}, {0.6f, 0.8f, 0.9f, 1}, 1.2));
    return Vtm::select(disc(96), inner, outer).toScene(256, 256);
}

void addRow(Report& report, const std::string& row, const std::string& ours, const std::string& paper) {
    report.summary.push_back({{"row", row}, {"ours", ours}, {"paper", paper}});
}

void timeSign(const Options& options, Report& report) {
    const scene::Scene scene = signOnASign();
    const paper::CompileResult compiled = paper::compile(scene);
    const asset::View view = viewOf(options.side, 1, 0);
    asset::View whole{options.side, options.side, {}};
    const double scale = options.side / scene.width;
    whole.toPixels = {scale, 0, 0, scale, 0, 0};
    paper::Cost cost;
    paper::evaluate(compiled.asset, whole, &cost);
    const double pixels = double(options.side) * options.side;
    paper::Pattern pattern(stars(1, paperDepth).asset.masks.at(0), {false, false, false});
    paper::Renderer renderer;
    const paper::Texture texture(compiled.asset);
    const Paired time = pairwise([&] { pattern.draw(view); }, [&] { renderer.render(texture, whole); },
                                 options.quick ? 1000 : 6000, 41);
    if (!options.pictures.empty())
        image::writeFile(options.pictures + "/sign on a sign.png",
                         image::encodePng(image::toBitmap(renderer.render(texture, whole))));
    addRow(report, "5: three VTMs over four gradients (Figure 7)",
           fmt::format("{} masks, {} nodes, {:.2f} visited a pixel; {:.3g} ms with reading back, {:.2f} of "
                       "row 11's first form",
                       compiled.asset.masks.size(), compiled.asset.nodes.size(), double(cost.nodes) / pixels,
                       time.second, time.ratio),
           "62 fps beside 61 fps");
    const paper::Surface ground = floor(4);
    const glm::ivec2 raster(options.side);
    const Paired onFloor =
        pairwise([&] { renderer.render(texture, whole); }, [&] { renderer.render(texture, ground, raster); },
                 options.quick ? 1000 : 6000, 41);
    if (!options.pictures.empty())
        image::writeFile(options.pictures + "/signs on a floor.png",
                         image::encodePng(image::toBitmap(renderer.render(texture, ground, raster))));
    addRow(
        report, "12: the same on a floor to the horizon",
        fmt::format("{:.3g} ms with reading back, {:.2f} of the flat picture", onFloor.second, onFloor.ratio),
        "as an ordinary texture");
}

void countText(Report& report) {
    const std::string folder = "/usr/share/fonts/truetype/dejavu/";
    if (!std::filesystem::exists(folder + "DejaVuSerif.ttf") ||
        !std::filesystem::exists(folder + "DejaVuSansMono.ttf")) {
        report.notes.push_back("the DejaVu fonts are not installed: row 13 is not counted");
        return;
    }
    font::FontMaps serif(image::readFile(folder + "DejaVuSerif.ttf")),
        mono(image::readFile(folder + "DejaVuSansMono.ttf"));
    std::u32string latin, text;
    for (char32_t c = U' '; latin.size() < 256; ++c)
        if (serif.advanceOf(c))
            latin += c;
    while (text.size() < 5000)
        text += U"The sign on the sign shows the sign again. ";
    text.resize(5000);
    font::CellText cells;
    cells.columns = 100;
    cells.rows = 50;
    cells.text = text;
    font::Typesetter setter(serif, 600, 800);
    setter.add(text, {40, 40, 520, 720}, {.size = 10});
    const asset::TextPage fixed = font::Typesetter::cells(mono, cells), variable = setter.page();
    serif.addCharacters(latin);
    const std::size_t fontBytes = asset::write(serif.asset()).size();
    const gl::TextTexture fixedTexture(mono.asset(), {fixed}), variableTexture(serif.asset(), {variable});
    const auto each = [](std::size_t bytes) {
        return fmt::format("{:.2f} bytes a character of 5000, symbols included", double(bytes) / 5000);
    };
    addRow(report, "13: text of fixed width", each(fixedTexture.bytes(0)), "1 byte");
    addRow(report, "13: text of variable width", each(variableTexture.bytes(0)), "8 bytes");
    addRow(report, "13: a font, 256 glyphs", fmt::format("{:.0f} KB", double(fontBytes) / 1024), "128 KB");
}

}  // namespace

Report paper(const Options& options) {
    Report report;
    report.name = "paper";
    report.title = "The paper's figures: rows 5 to 13";
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
        "periods here, from the mip alone beyond 16, from both between; on the floor of row 12 each pixel "
        "reads both.",
        options.side, options.quick ? quickRounds : manyRounds);
    if (!count(report))
        report.notes.push_back(
            "glslangValidator (Debian: glslang-tools) is not installed: nothing is counted");
    const gl::Context context;
    timeForms("a star, 2 levels", stars(1, paperDepth), options, report);
    timeForms("nine stars, 3 levels", stars(3, 3), options, report);
    timeSign(options, report);
    countText(report);
    report.text += "\n\nDrawn on " + context.renderer() + ", " + context.version() + ".";
    return report;
}

}  // namespace vtm::bench
