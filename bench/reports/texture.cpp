#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <glm/matrix.hpp>

#include <vtm/compiler/compile.hpp>
#include <vtm/gl/renderer.hpp>
#include "backend_gl/testing.hpp"
#include "bench/input/files.hpp"
#include "bench/measure/measure.hpp"
#include "bench/reports/reports.hpp"

namespace vtm::bench {
namespace {

constexpr double budget = 3000, quickBudget = 800;  ///< CPU milliseconds a view
constexpr int maxPixels = 512;  ///< along a side: a software driver takes seconds for more

/// A plane of repeated pictures, by vtm_sample.
class Plane {
public:
    explicit Plane(const asset::Asset& asset)
        : texture_(asset), canvas_(gl::sampleInclude({asset}), R"(
uniform Vtm picture;
uniform mat3 toPicture;
vec4 shade(vec2 pixel) {
    vec3 p = toPicture * vec3(pixel, 1.0);
    return vtm_sample_proj(picture, p);
})") {}

    /// `toPicture`: (pixel, 1) to homogeneous (s, t).
    void draw(const glm::dmat3& toPicture, int side) {
        texture_.bind(canvas_.program(), "picture", 0, {asset::Wrap::Repeat, asset::Wrap::Repeat});
        canvas_.set("toPicture", toPicture);
        canvas_.drawOnly(side, side);
    }

private:
    gl::SampledTexture texture_;
    gl::test::ShaderCanvas canvas_;
};

/// So many pictures along the raster, turned a little more each round.
glm::dmat3 flat(int side, double periods, int round) {
    const double angle = 0.1 + 0.02 * round;
    const glm::dvec2 x = periods / side * glm::dvec2(std::cos(angle), std::sin(angle));
    return {{x.x, -x.y, 0}, {x.y, x.x, 0}, {0, 0, 1}};
}

/// A floor up to a horizon just above the raster, moving on each round: in the first row one picture is as
/// wide as the raster, and footprints are 8 times as long as wide in the last.
glm::dmat3 floorUpToTheHorizon(int side, int round) {
    const double horizon = side / 16.0, b = 0.9 / side * (horizon + side), a = 8 * b * horizon;
    const glm::dmat3 moved({1, 0, 0}, {0, 1, 0}, {0.01 * round, 0.03 * round, 1});
    return moved * glm::dmat3({b, 0, 0}, {0.5, 0, 1}, {0.5 * horizon - b * side / 2, a, horizon});
}

asset::View turned(const scene::Scene& scene, int side, int round) {
    const double scale = side / std::max(scene.width, scene.height), angle = 0.1 + 0.02 * round;
    const double c = scale * std::cos(angle), s = scale * std::sin(angle);
    return {side, side, {c, s, -s, c, 0.05 * side, -0.05 * side}};
}

struct Sampling {
    const char* name;
    glm::dmat3 (*toPicture)(int side, int round);
};
constexpr Sampling samplings[] = {
    {"flat, one picture", [](int side, int round) { return flat(side, 1, round); }},
    {"flat, 4 x 4", [](int side, int round) { return flat(side, 4, round); }},
    {"minified, 16 x 16", [](int side, int round) { return flat(side, 16, round); }},
    {"perspective, to the horizon", floorUpToTheHorizon}};

}  // namespace

Report texture(const Options& options) {
    const int side = std::min(options.side, maxPixels);
    Options few = options;
    few.quick = true;
    const gl::Context context;
    gl::Renderer renderer({.pixels = gl::Pixels::Shaders, .programCache = {}, .resetStatus = {}});
    Report report;
    report.name = "texture";
    report.title = "Pictures as textures";
    report.text = fmt::format(
        "`vtm_sample` on all of {0} × {0} pixels, repeated, against `gl::Renderer` with shaders drawing the "
        "picture "
        "once in the same space, in turns, both moving: CPU milliseconds, medians, and the ratio pair by "
        "pair. "
        "Textures go into RGBA32F. On {1}, {2}. No peer draws vector pictures in perspective.",
        side, context.renderer(), context.version());
    for (const File& file : options.quick ? oneFileOf(options) : filesOf(few)) {
        const scene::Scene scene = load(file);
        const asset::Asset asset = compiler::compile(scene).asset;
        const gl::Texture uploaded = renderer.upload(asset);
        Plane plane(asset);
        for (const Sampling& sampling : samplings) {
            int drawn = 0, sampled = 0;
            const Paired time = pairwise([&] { renderer.draw(uploaded, turned(scene, side, drawn++)); },
                                         [&] { plane.draw(sampling.toPicture(side, sampled++), side); },
                                         options.quick ? quickBudget : budget, 41);
            report.rows.push_back({{"file", file.name},
                                   {"view", sampling.name},
                                   {"picture ms", time.first},
                                   {"texture ms", time.second},
                                   {"texture / picture", time.ratio},
                                   {"quartiles", fmt::format("{:.3g}-{:.3g}", time.low, time.high)},
                                   {"pairs", time.pairs}});
        }
    }
    return report;
}

}  // namespace vtm::bench
