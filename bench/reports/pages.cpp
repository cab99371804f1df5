// Pages of text as textures: tables over a font, beside the same page as an asset of instances and as a
// bitmap.

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/core.h>
#include <glm/matrix.hpp>

#include <vtm/compiler/compile.hpp>
#include <vtm/font/typesetter.hpp>
#include <vtm/gl/text_texture.hpp>
#include <vtm/image/codec.hpp>
#include "bench/engines/contest.hpp"
#include "bench/engines/textures.hpp"
#include "bench/input/text_pages.hpp"
#include "bench/measure/measure.hpp"
#include "bench/reports/reports.hpp"
#include "conformance/compare/compare.hpp"

namespace vtm::bench {
namespace {

using asset::TextPage;
using image::Raster;

constexpr Budget pageBudget{4000, 400};                          ///< of a view and a pair
constexpr int maxPixels = 1024, errorPixels = 192, samples = 6;  ///< the truth takes samples² times as many

constexpr const char* fontFolder = "/usr/share/fonts/truetype/dejavu/";
constexpr double pageWidth = 600, pageHeight = 800;

/// Some 5000 characters. The words are no text, but as long as those of one.
std::u32string words() {
    std::u32string text;
    for (unsigned i = 0; text.size() < 5000; ++i) {
        for (unsigned k = 0; k < 2 + (i * 7 + i / 3) % 9; ++k)
            text += U"etaoinshrdlucmfwygpbvkETAO,."[(i * 31 + k * k * 5 + i / 11) % 28];
        text += U' ';
    }
    return text;
}

TextPage letters(font::FontMaps& font) {
    font::Typesetter setter(font, pageWidth, pageHeight, {1, 1, 1, 1});
    setter.add(words(), {30, 30, pageWidth - 60, pageHeight - 60}, {.size = 11});
    return setter.page();
}

TextPage cells(font::FontMaps& font) {
    font::CellText text;
    text.columns = 84;
    text.rows = 60;
    text.text = words().substr(0, std::size_t(text.columns) * text.rows);
    text.size = pageWidth / (84 * 0.602);
    text.ground = {1, 1, 1, 1};
    return font::Typesetter::cells(font, text);
}

/// `pixels` of the page's width along the raster, turned a little more each round.
glm::dmat3 flat(int side, double pixels, int round) {
    const double angle = 0.05 + 0.02 * round;
    const glm::dvec2 x = glm::dvec2(std::cos(angle), std::sin(angle)) / pixels;
    const glm::dmat3 turn({x.x, -x.y, 0}, {x.y, x.x, 0},
                          {0.5 - 0.5 * side * (x.x + x.y), 0.4 + 0.5 * side * (x.y - x.x), 1});
    return glm::dmat3({1, 0, 0}, {0, pageWidth / pageHeight, 0}, {0, 0, 1}) * turn;
}

/// A page that leans back: twice as far away at its top.
glm::dmat3 leaning(int side, int round) {
    const double s = 1.0 / side, shift = 0.01 * round;
    return glm::dmat3({1.6 * s, 0, 0}, {-0.8 * s, 1.1 * s, -0.5 * s}, {-0.3 + shift, -0.05, 1});
}

struct Sampling {
    const char* name;
    glm::dmat3 (*toPage)(int side, int round);
};
constexpr Sampling samplings[] = {
    {"flat, as wide as the raster", [](int side, int round) { return flat(side, side, round); }},
    {"flat, 8 times as wide", [](int side, int round) { return flat(side, 8.0 * side, round); }},
    {"minified, an eighth", [](int side, int round) { return flat(side, side / 8.0, round); }},
    {"leaning back", leaning}};

class TableWay : public TextureWay {
public:
    TableWay(const char* called, gl::TextTexture texture, std::size_t index)
        : TextureWay(called, gl::textInclude(), sampleVtm, texture.bytes(index)),
          texture_(std::move(texture)),
          index_(index) {}

private:
    void bind(GLuint program) override { texture_.bind(program, "picture", 0, index_); }

    gl::TextTexture texture_;
    std::size_t index_;
};

std::string errors(const Raster& drawn, const Raster& truth) {
    const compare::Difference error = compare::compare(drawn, truth);
    return fmt::format("{:.2g}, {:.3g}", error.rms, error.max);
}

/// A flat page of as many characters by Qt's OpenGL engine, which draws its outlines anew in every frame.
void addQt(const Options& options, int side, Report& report) {
    constexpr Kind turning{.name = "turning"};
    Contenders all = contenders(options, report.notes);
    std::erase_if(all,
                  [](const Contender& one) { return !one.ours && !one.engine->name().starts_with("qt-gl"); });
    const auto folder = std::filesystem::temp_directory_path() / fmt::format("vtm_bench_pages_{}", getpid());
    std::filesystem::create_directories(folder);
    const std::vector<File> files = writeTextPages(folder, report.notes);
    if (!files.empty()) {
        const LoadedFile page{files.front(), load(files.front())};
        const std::size_t bytes = asset::summarize(compiler::compile(page.scene).asset).bytes;
        prepare(all, page, {&turning, 1}, options, report.notes);
        takeTurns(all, page, turning, side, patienceOf(options), report.notes);
        for (const Contender& one : all)
            if (!one.times.empty())
                report.rows.push_back({{"view", "flat, a page of paths"},
                                       {"as", one.engine->name()},
                                       {"ms", fmt::format("{:.3g}", median(one.times))},
                                       {"rms, max", "-"},
                                       {"bytes", bytes}});
    }
    std::filesystem::remove_all(folder);
}

}  // namespace

Report pages(const Options& options) {
    const int side = std::min(options.side, maxPixels);
    const gl::Context context;
    Report report;
    report.name = "pages";
    report.title = "Pages of text as textures";
    report.text = fmt::format(
        "A page of some 5000 characters on {0} × {0} pixels, moving, by a fragment shader: as a table of 8 "
        "bytes a character over a "
        "font (`letters`), of 1 byte (`cells`), as an asset of instances by `vtm_sample`, and as a "
        "mip-mapped bitmap "
        "of 4096² pixels with 16 × anisotropy where the driver has it. CPU milliseconds, medians, each in "
        "turns with the bitmap; in "
        "brackets the ratio to it, pair by pair; then rms and max error of 255 against the mean of 36 points "
        "a pixel. Bytes without "
        "the font ({{}} bytes for both) and without pyramids of means, but with the bitmap's. Into RGBA32F. "
        "Last, a flat page of as many characters turning, as a picture by our engines and by Qt's OpenGL "
        "engine, with one sample and with four. "
        "On {1}, {3}.",
        side, context.renderer(), errorPixels, context.version());
    const std::string serif = std::string(fontFolder) + "DejaVuSerif.ttf",
                      mono = std::string(fontFolder) + "DejaVuSansMono.ttf";
    if (!std::filesystem::exists(serif) || !std::filesystem::exists(mono)) {
        report.notes.push_back("pages: missing, the DejaVu fonts are not installed");
        return report;
    }
    font::FontMaps serifFont(image::readFile(serif)), monoFont(image::readFile(mono));
    const TextPage letterPage = letters(serifFont), cellPage = cells(monoFont);
    const asset::Asset flatPage = asset::pageAsset(letterPage, serifFont.asset());
    gl::TextTexture letterTexture(serifFont.asset(), {letterPage}), cellTexture(monoFont.asset(), {cellPage});
    report.text = fmt::format(fmt::runtime(report.text), letterTexture.fontBytes() + cellTexture.fontBytes());
    BitmapWay bitmap("bitmap", flatPage, options.quick ? 1024 : 4096);
    TableWay letterWay("letters", std::move(letterTexture), 0), cellWay("cells", std::move(cellTexture), 0);
    AssetWay assetWay("asset", flatPage, {}, asset::summarize(flatPage).bytes);
    for (const Sampling& sampling : samplings) {
        const int few = std::min(side, errorPixels);
        const glm::dmat3 first = sampling.toPage(few, 0);
        const Raster truth = truthOf(letterWay, first, few, samples),
                     cellTruth = truthOf(cellWay, first, few, samples);
        for (TextureWay* const way :
             {static_cast<TextureWay*>(&letterWay), static_cast<TextureWay*>(&cellWay),
              static_cast<TextureWay*>(&assetWay), static_cast<TextureWay*>(&bitmap)}) {
            int a = 0, b = 0;
            const Paired time = pairwise([&] { bitmap.drawOnly(sampling.toPage(side, a++), side); },
                                         [&] { way->drawOnly(sampling.toPage(side, b++), side); },
                                         pageBudget.of(options), 41);
            report.rows.push_back(
                {{"view", sampling.name},
                 {"as", way->name},
                 {"ms", fmt::format("{:.3g} ({:.3g})", time.second, time.ratio)},
                 {"rms, max", errors(way->draw(first, few), way == &cellWay ? cellTruth : truth)},
                 {"bytes", way->bytes}});
        }
    }
    addQt(options, side, report);
    return report;
}

}  // namespace vtm::bench
