// Pages of text as textures: tables over a font, beside the same page as an asset of instances and as a
// bitmap.

#include <GLES3/gl3.h>
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
#include <vtm/raster/scan.hpp>
#include "backend_gl/testing.hpp"
#include "bench/engines/contest.hpp"
#include "bench/input/text_pages.hpp"
#include "bench/measure/measure.hpp"
#include "bench/reports/reports.hpp"

namespace vtm::bench {
namespace {

using asset::TextPage;
using image::Raster;

constexpr double budget = 4000, quickBudget = 400;  ///< CPU milliseconds a view and a pair
constexpr int maxPixels = 1024, errorPixels = 192;  ///< the truth takes 36 times as many
constexpr GLenum maxAnisotropy = 0x84FE;            // GL_TEXTURE_MAX_ANISOTROPY_EXT

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

/// One way to have a page as a texture.
class Way {
public:
    Way(std::string called, const std::string& include, const std::string& sample, std::size_t taken)
        : name(std::move(called)), bytes(taken), canvas_(include, R"(
uniform mat3 toPage;
)" + sample + R"(
vec4 shade(vec2 pixel) { return sampled(toPage * vec3(pixel, 1.0)); })") {}
    virtual ~Way() = default;
    Way(const Way&) = delete;
    Way& operator=(const Way&) = delete;

    void drawOnly(const glm::dmat3& toPage, int side) {
        bind(canvas_.program());
        canvas_.set("toPage", toPage);
        canvas_.drawOnly(side, side);
    }
    Raster draw(const glm::dmat3& toPage, int side) {
        bind(canvas_.program());
        canvas_.set("toPage", toPage);
        return canvas_.draw(side, side);
    }

    const std::string name;
    const std::size_t bytes;

private:
    virtual void bind(GLuint program) = 0;

    gl::test::ShaderCanvas canvas_;
};

constexpr const char* sampleVtm = R"(
uniform Vtm page;
vec4 sampled(vec3 stq) { return vtm_sample_proj(page, stq / gl_FragCoord.w); })";

class TableWay : public Way {
public:
    TableWay(const char* called, gl::TextTexture texture, std::size_t index)
        : Way(called, gl::textInclude(), sampleVtm, texture.bytes(index)),
          texture_(std::move(texture)),
          index_(index) {}

private:
    void bind(GLuint program) override { texture_.bind(program, "page", 0, index_); }

    gl::TextTexture texture_;
    std::size_t index_;
};

class AssetWay : public Way {
public:
    AssetWay(const char* called, const asset::Asset& page)
        : Way(called, gl::sampleInclude({page}), sampleVtm, asset::summarize(page).bytes), texture_(page) {}

private:
    void bind(GLuint program) override { texture_.bind(program, "page", 0); }

    gl::SampledTexture texture_;
};

/// A mip-mapped bitmap, 4096 pixels high, as exact as bytes can be.
class BitmapWay : public Way {
public:
    BitmapWay(const char* called, const asset::Asset& page, int side)
        : Way(called, "precision highp float;\n", R"(
uniform sampler2D bitmap;
vec4 sampled(vec3 stq) {
    vec2 st = stq.xy / stq.z;
    return textureGrad(bitmap, st, dFdx(st), dFdy(st)) * float(all(equal(st, clamp(st, 0.0, 1.0))));
})",
              std::size_t(side) * side * 4 * 4 / 3) {
        asset::View view{side, side, {}};
        view.toPixels = {side / page.width, 0, 0, side / page.height, 0, 0};
        const image::Bitmap bitmap = image::toBitmap(asset::Scanner(page).draw(view));
        glGenTextures(1, &texture_);
        glBindTexture(GL_TEXTURE_2D, texture_);
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, side, side, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                     bitmap.rgba.data());
        glGenerateMipmap(GL_TEXTURE_2D);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
        glTexParameteri(GL_TEXTURE_2D, maxAnisotropy, 16);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        while (glGetError() != GL_NO_ERROR) {
        }  // a driver without anisotropy
    }
    ~BitmapWay() override { glDeleteTextures(1, &texture_); }

private:
    void bind(GLuint program) override {
        glUseProgram(program);
        glUniform1i(glGetUniformLocation(program, "bitmap"), 0);
        glActiveTexture(GL_TEXTURE0);
        glBindSampler(0, 0);
        glBindTexture(GL_TEXTURE_2D, texture_);
    }

    GLuint texture_ = 0;
};

/// The mean over 6 × 6 points a pixel, each with a footprint as small as that.
Raster truthOf(Way& exact, const glm::dmat3& toPage, int side) {
    constexpr int samples = 6;
    const glm::dmat3 smaller({1.0 / samples, 0, 0}, {0, 1.0 / samples, 0}, {0, 0, 1});
    const Raster fine = exact.draw(toPage * smaller, side * samples);
    Raster mean(side, side);
    for (int y = 0; y < side * samples; ++y)
        for (int x = 0; x < side * samples; ++x)
            for (std::size_t c = 0; c < 4; ++c)
                mean.rgba[4 * (std::size_t(y / samples) * side + x / samples) + c] +=
                    fine.rgba[4 * (std::size_t(y) * side * samples + x) + c] / float(samples * samples);
    return mean;
}

std::string errors(const Raster& drawn, const Raster& truth) {
    double max = 0, squares = 0;
    for (std::size_t i = 0; i < truth.rgba.size(); ++i) {
        const double d = 255 * std::abs(double(drawn.rgba[i]) - double(truth.rgba[i]));
        max = std::max(max, d);
        squares += d * d;
    }
    return fmt::format("{:.2g}, {:.3g}", std::sqrt(squares / double(truth.rgba.size())), max);
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
        CompiledFile page{files.front(), load(files.front()), {}};
        page.asset = compiler::compile(page.scene).asset;
        prepare(all, page, {&turning, 1}, options, report.notes);
        takeTurns(all, page, turning, side, patienceOf(options), report.notes);
        for (const Contender& one : all)
            if (!one.times.empty())
                report.rows.push_back({{"view", "flat, a page of paths"},
                                       {"as", one.engine->name()},
                                       {"ms", fmt::format("{:.3g}", median(one.times))},
                                       {"rms, max", "-"},
                                       {"bytes", asset::summarize(page.asset).bytes}});
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
    AssetWay assetWay("asset", flatPage);
    for (const Sampling& sampling : samplings) {
        const int few = std::min(side, errorPixels);
        const glm::dmat3 first = sampling.toPage(few, 0);
        const Raster truth = truthOf(letterWay, first, few), cellTruth = truthOf(cellWay, first, few);
        for (Way* const way : {static_cast<Way*>(&letterWay), static_cast<Way*>(&cellWay),
                               static_cast<Way*>(&assetWay), static_cast<Way*>(&bitmap)}) {
            int a = 0, b = 0;
            const Paired time = pairwise([&] { bitmap.drawOnly(sampling.toPage(side, a++), side); },
                                         [&] { way->drawOnly(sampling.toPage(side, b++), side); },
                                         options.quick ? quickBudget : budget, 41);
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
