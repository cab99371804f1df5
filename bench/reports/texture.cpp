// Pictures as textures beside mip-mapped bitmaps: time, error and memory.

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <vector>

#include <fmt/core.h>
#include <glm/matrix.hpp>

#include <vtm/compiler/compile.hpp>
#include <vtm/gl/renderer.hpp>
#include <vtm/raster/prefilter.hpp>
#include "bench/engines/textures.hpp"
#include "bench/input/files.hpp"
#include "bench/input/text_pages.hpp"
#include "bench/measure/measure.hpp"
#include "bench/reports/reports.hpp"
#include "bench/reports/texture_views.hpp"
#include "conformance/compare/compare.hpp"

namespace vtm::bench {
namespace {

constexpr Budget viewBudget{600, 400};  ///< of a view and a pair
constexpr int maxPixels = 512;          ///< along a side: a software driver takes seconds for more
/// The truth takes samples² times as many. With 8 × 8, those of a page of text at the horizon take more turns
/// than a pixel may, so the page's mean stands for them.
constexpr int errorPixels = 128, samples = 16;

asset::View turned(const asset::Asset& picture, int side, int round) {
    const double scale = side / std::max(picture.width, picture.height), angle = 0.1 + 0.02 * round;
    const double c = scale * std::cos(angle), s = scale * std::sin(angle);
    return {side, side, {c, s, -s, c, 0.05 * side, -0.05 * side}};
}

/// The pictures that are measured, and a page of text.
std::vector<File> filesAndPage(const Options& options, const std::filesystem::path& folder, Report& report) {
    if (options.quick)
        return oneFileOf(options);
    Options few = options;
    few.quick = true;
    std::vector<File> files = filesOf(few);
    if (options.only.empty() && options.files.empty())
        if (const std::vector<File> pages = writeTextPages(folder, report.notes); !pages.empty())
            files.push_back(pages.front());
    return files;
}

/// Drawn from the tree at all sizes: a mean of the whole picture is no prefilter.
asset::Asset withoutMeans(asset::Asset picture) {
    picture.prefilter = asset::buildPrefilter(picture, asset::PyramidSize{1, 1});
    return picture;
}

class FileRows {
public:
    FileRows(const File& file, const Options& options, gl::Renderer& renderer, Report& report)
        : file_(file),
          options_(options),
          side_(std::min(options.side, maxPixels)),
          renderer_(renderer),
          report_(report),
          asset_(compiler::compile(load(file)).asset),
          vtm_("vtm_sample", asset_, {asset::Wrap::Repeat, asset::Wrap::Repeat}),
          exact_("exact", withoutMeans(asset_), {asset::Wrap::Repeat, asset::Wrap::Repeat}) {
        for (const int pixels : options.quick ? std::vector{1024} : std::vector{256, 1024, 4096})
            bitmaps_.push_back(std::make_unique<BitmapWay>(fmt::format("bitmap, {}", pixels), asset_, pixels,
                                                           BitmapWay::Beyond::Repeated));
    }

    void add() {
        addPicture();
        for (const TextureView& view : textureViews) {
            const int few = std::min(side_, errorPixels);
            const image::Raster truth = truthOf(exact_, view.toTexture(few, 0), few, samples);
            addWay(view, vtm_, truth);
            for (const std::unique_ptr<BitmapWay>& bitmap : bitmaps_)
                addWay(view, *bitmap, truth);
        }
    }

private:
    double budget() const { return viewBudget.of(options_); }

    void addPicture() {
        const gl::Texture uploaded = renderer_.upload(asset_);
        int a = 0, b = 0;
        const Paired time =
            pairwise([&] { vtm_.drawOnly(textureViews[0].toTexture(side_, a++), side_); },
                     [&] { renderer_.draw(uploaded, turned(asset_, side_, b++)); }, budget(), 41);
        addRow(textureViews[0].name, "picture", time, "-", "-");
    }

    void addWay(const TextureView& view, TextureWay& way, const image::Raster& truth) {
        int a = 0, b = 0;
        const Paired time = pairwise([&] { vtm_.drawOnly(view.toTexture(side_, a++), side_); },
                                     [&] { way.drawOnly(view.toTexture(side_, b++), side_); }, budget(), 41);
        const int few = std::min(side_, errorPixels);
        const compare::Difference error = compare::compare(way.draw(view.toTexture(few, 0), few), truth);
        addRow(view.name, way.name, time, fmt::format("{:.2g}, {:.3g}", error.rms, error.max),
               fmt::format("{:.3g}", double(way.bytes) / 1e6));
    }

    void addRow(const char* view, const std::string& way, const Paired& time, const std::string& error,
                const std::string& megabytes) {
        Json row{{"file", file_.name}, {"view", view},      {"as", way},
                 {"ms", time.second},  {"rms, max", error}, {"MB", megabytes}};
        Json& shown = report_.summary.emplace_back(row);
        shown["ms"] = fmt::format("{:.3g} ({:.3g})", time.second, time.ratio);
        row["ratio"] = time.ratio;
        report_.rows.push_back(std::move(row));
    }

    const File& file_;
    const Options& options_;
    const int side_;
    gl::Renderer& renderer_;
    Report& report_;
    asset::Asset asset_;
    AssetWay vtm_, exact_;
    std::vector<std::unique_ptr<BitmapWay>> bitmaps_;
};

}  // namespace

Report texture(const Options& options) {
    const gl::Context context;
    gl::Renderer renderer({.pixels = gl::Pixels::Shaders, .programCache = {}, .resetStatus = {}});
    Report report;
    report.name = "texture";
    report.title = "Pictures as textures";
    report.text = fmt::format(
        "`vtm_sample` on all of {0} × {0} pixels, repeated and moving, beside mip-mapped bitmaps (longer "
        "side in "
        "pixels, trilinear, 16 × anisotropy where the driver has it) and, in the flat view, beside "
        "`gl::Renderer` "
        "with shaders drawing the picture once in the same space. {1} milliseconds, medians, each in turns "
        "with "
        "`vtm_sample`; in brackets the ratio to it, pair by pair. Then rms and max error of 255 against the "
        "mean of "
        "{2} exact parts of each pixel at {3} × {3}, and megabytes on the GPU. Textures go into RGBA32F. On "
        "{4}, {5}. "
        "No peer "
        "draws vector pictures in perspective.",
        std::min(options.side, maxPixels), clockName(), samples * samples, errorPixels, context.renderer(),
        context.version());
    const auto folder =
        std::filesystem::temp_directory_path() / fmt::format("vtm_bench_texture_{}", getpid());
    std::filesystem::create_directories(folder);
    for (const File& file : filesAndPage(options, folder, report))
        FileRows(file, options, renderer, report).add();
    std::filesystem::remove_all(folder);
    return report;
}

}  // namespace vtm::bench
