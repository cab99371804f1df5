#include "tests/fuzz/pipeline_run.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include <vtm/asset/container.hpp>
#include <vtm/compiler/compile.hpp>
#include <vtm/raster/evaluate.hpp>
#include <vtm/raster/prefilter.hpp>
#include <vtm/raster/scan.hpp>
#include <vtm/svg/load.hpp>
#include "conformance/reference/reference.hpp"
#include "tests/fuzz/scene_of_bytes.hpp"

namespace vtm::fuzz {
namespace {

constexpr int raster = 16;

/// Of solid colours, in 1/255: docs/testing.md.
constexpr double scannerToEvaluator = 2, scannerToReference = 4;

/// The reference draws so few pieces in milliseconds.
constexpr std::size_t piecesForReference = 400;

/// What one run may cost.
void limit(compiler::Options& options) { options.maxWork = 3'000'000; }

/// Of the seven bytes that the settings are made of.
struct Settings {
    compiler::Options options;
    asset::View whole, part;

    Settings(std::span<const std::uint8_t> bytes, const scene::Scene& scene) {
        const auto byte = [&](std::size_t i) { return i < bytes.size() ? unsigned(bytes[i]) : 0u; };
        constexpr int bits[] = {12, 16, 10, 20};
        options.tolerance = std::ldexp(1.0, -bits[byte(0) % 4]);
        options.mode = byte(1) % 16 == 15 ? asset::Mode::Compat : asset::Mode::Exact;
        if (byte(2) % 4 == 3)
            options.piecesPerLeaf = 1 + byte(2) / 4;
        limit(options);
        // Boundaries lie within 1/64 of a pixel.
        const double side = std::max(scene.width, scene.height),
                     finest = std::min(1 << 12, 1 << (bits[byte(0) % 4] - 6));
        const double maximum = std::max(1.0, finest / raster), zoom = 1 + (maximum - 1) * byte(3) / 255;
        whole = {raster, raster, {raster / side, 0, 0, raster / side, 0, 0}};
        const double scale = raster * zoom / side, angle = byte(4) / 40.0;
        const glm::dvec2 x = scale * glm::dvec2(std::cos(angle), std::sin(angle)), y{-x.y, x.x},
                         focus{scene.width * byte(5) / 255, scene.height * byte(6) / 255};
        part = {raster, raster, {x, y, glm::dvec2(raster / 2.0) - x * focus.x - y * focus.y}};
    }
    static constexpr std::size_t bytesUsed = 7;
};

struct Source {
    scene::Scene scene;
    /// Compared with the reference, if its paints are solid.
    bool isSteady = false;
};

std::optional<Source> sourceOf(std::span<const std::uint8_t> bytes) {
    if (bytes.empty() || bytes.front() != '<') {
        ByteScene made = sceneOfBytes(bytes.subspan(std::min(bytes.size(), Settings::bytesUsed)));
        return Source{std::move(made.scene), made.isSteady};
    }
    try {
        return Source{svg::load(bytes).scene, false};
    } catch (const svg::ParseError&) {
        return std::nullopt;
    }
}

bool isSolid(const asset::Asset& asset) { return std::ranges::none_of(asset.paints, asset::isProgram); }

/// Written, read, written.
asset::Asset stored(const asset::Asset& asset) {
    const std::vector<std::uint8_t> file = asset::write(asset);
    asset::Asset back = asset::read(file);
    if (asset::write(back) != file)
        throw Disagreement("what was read is written as other bytes");
    return back;
}

void checkColors(const image::Raster& drawn, const char* engine) {
    for (const float value : drawn.rgba)
        if (!(value >= 0 && value <= 1))
            throw Disagreement(fmt::format("{}: a channel is {}", engine, value));
}

void compare(const image::Raster& drawn, const image::Raster& wanted, double maximum, const char* what) {
    for (std::size_t i = 0; i < drawn.rgba.size(); ++i)
        if (const double off = 255 * std::abs(double(drawn.rgba[i]) - double(wanted.rgba[i]));
            !(off <= maximum))
            throw Disagreement(fmt::format("{}: off by {:.2f}/255 at pixel {}, {}", what, off,
                                           i / 4 % std::size_t(drawn.width),
                                           i / 4 / std::size_t(drawn.width)));
}

/// Draws a view by all engines that can; whether the reference was among them.
bool draw(const asset::Asset& asset, const asset::View& view, const Source& source, bool isQuick) {
    const image::Raster evaluated = asset::evaluate(asset, view);
    checkColors(evaluated, "evaluator");
    if (!asset::isSumOfMaps(asset))
        return false;
    const image::Raster scanned = asset::Scanner(asset).draw(view);
    checkColors(scanned, "scanner");
    if (!isSolid(asset))
        return false;
    compare(scanned, evaluated, scannerToEvaluator, "scanner and evaluator");
    if (!isQuick)
        return false;
    compare(scanned, reference::render(source.scene, {view.width, view.height, view.toPixels}),
            scannerToReference, "scanner and reference");
    return true;
}

}  // namespace

Outcome runPipeline(std::span<const std::uint8_t> bytes) {
    const std::optional<Source> source = sourceOf(bytes);
    if (!source)
        return Outcome::Refused;
    const Settings settings(bytes, source->scene);
    compiler::Result compiled;
    try {
        compiled = compiler::compile(source->scene, settings.options);
    } catch (const compiler::LimitError&) {
        return Outcome::Refused;
    }
    const asset::Asset asset = stored(compiled.asset);
    const bool isQuick = source->isSteady && compiled.unproven.empty() &&
                         asset.pieces.size() <= piecesForReference &&
                         compiled.provenError <= settings.options.tolerance;
    bool isCompared = false;
    for (const asset::View& view : {settings.whole, settings.part})
        isCompared |= draw(asset, view, *source, isQuick);
    return isCompared ? Outcome::Compared : Outcome::Drawn;
}

}  // namespace vtm::fuzz
