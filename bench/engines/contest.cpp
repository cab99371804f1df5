#include "bench/engines/contest.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include <vtm/image/codec.hpp>

namespace vtm::bench {
namespace {

constexpr int squares = 64;  ///< along a picture's longer side, for comparing pictures

/// Of the means of premultiplied channels over squares, of 255: rough edges even out, what is missing
/// remains.
double rmsDifference(const image::Bitmap& a, const image::Bitmap& b) {
    const image::Raster first = image::toRaster(a), second = image::toRaster(b);
    const int side = std::max(1, std::max(a.width, a.height) / squares);
    image::Raster means((a.width + side - 1) / side, (a.height + side - 1) / side);
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x)
            for (int channel = 0; channel < 4; ++channel)
                means.pixel(x / side, y / side)[channel] +=
                    (first.pixel(x, y)[channel] - second.pixel(x, y)[channel]) / float(side * side);
    double sum = 0;
    for (const float mean : means.rgba)
        sum += double(mean) * double(mean);
    return 255 * std::sqrt(sum / double(means.rgba.size()));
}

/// Whether an engine of those still in did it. `where`: the picture and the views, for the note.
template <class Work>
bool did(Contender& one, const std::string& where, std::vector<std::string>& notes, Work&& work) {
    try {
        if (one.able)
            work();
    } catch (const std::exception& error) {
        one.able = false;
        notes.push_back(fmt::format("{}: not by {}: {}.", where, one.engine->name(), error.what()));
    }
    return one.able;
}

void writePicture(Engine& engine, const LoadedFile& picture, const Kind& kind, const Options& options) {
    const std::string name =
        fmt::format("{}_{}x_{}.png", picture.file.name, kind.zoom * kind.size, engine.name());
    const image::Bitmap drawn = engine.pixels(viewOf(picture.scene, options.side, kind, 0));
    image::writeFile((std::filesystem::path(options.pictures) / name).string(), encodePng(drawn));
}

/// What was built with us; nothing of the others, which are noted.
std::vector<std::string> builtCommands([[maybe_unused]] std::vector<std::string>& notes) {
    std::vector<std::string> commands;
#ifdef VTM_BENCH_QT
    commands.emplace_back("if [ -n \"$DISPLAY\" ]; then exec '" VTM_BENCH_QT
                          "'; elif command -v xvfb-run >/dev/null; then exec xvfb-run -a '" VTM_BENCH_QT
                          "'; else QT_QPA_PLATFORM=offscreen exec '" VTM_BENCH_QT "'; fi");
#else
    notes.push_back("qt-raster, qt-gl, qt-gl-4: missing, built without Qt (qtbase5-dev, libqt5svg5-dev).");
#endif
#ifdef VTM_BENCH_BLEND2D
    commands.emplace_back("exec '" VTM_BENCH_BLEND2D "'");
#else
    notes.push_back("blend2d: missing, no folder VTM_BENCH_PEERS with it was named at configuring.");
#endif
#ifdef VTM_BENCH_NANOVG
    commands.emplace_back("exec '" VTM_BENCH_NANOVG "'");
#else
    notes.push_back("nanovg: missing, no folder VTM_BENCH_PEERS with it was named at configuring.");
#endif
#ifdef VTM_BENCH_THORVG
    commands.emplace_back("exec '" VTM_BENCH_THORVG "'");
    commands.emplace_back("exec '" VTM_BENCH_THORVG "' gl");
#else
    notes.push_back(
        "thorvg, thorvg-gl: missing, no folder VTM_BENCH_PEERS with it was named at configuring.");
#endif
    return commands;
}

/// Of those that are built into this program.
std::string servedBy(const Options& options, const std::string& engine) {
    return "exec '" + options.program + "' serve " + engine;
}

/// In the table's order; ratios in the table are against the last one.
std::vector<std::string> ourCommands(const Options& options) {
    return {servedBy(options, "shaders"), servedBy(options, "gl"), servedBy(options, "scan")};
}

std::vector<std::string> peerCommands(const Options& options, std::vector<std::string>& notes) {
    std::vector<std::string> commands{servedBy(options, "cairo"), servedBy(options, "librsvg")};
    std::ranges::copy(builtCommands(notes), std::back_inserter(commands));
    if (options.nodeModules.empty())
        notes.push_back("skia, resvg: missing, no folder with node_modules is named.");
    else
        for (const std::string name : {"skia", "resvg"})
            commands.push_back("exec node '" VTM_SOURCE_DIR "/bench/peers.mjs' '" + options.nodeModules +
                               "' " + name);
    std::ranges::copy(options.peers, std::back_inserter(commands));
    return commands;
}

}  // namespace

Patience patienceOf(const Options& options) {
    return options.quick ? Patience{500, 5, 15, 1000} : Patience{4000, 5, 41, 1000};
}

asset::View viewOf(const scene::Scene& scene, int side, const Kind& kind, int step) {
    const double fit = side * kind.size / std::max(scene.width, scene.height);
    const double zoom = kind.zooming ? std::exp2(step - 4) : kind.zoom;
    asset::View view;
    view.width = std::max(1, int(std::lround(fit * scene.width)));
    view.height = std::max(1, int(std::lround(fit * scene.height)));
    const double angle = 0.1 + 0.02 * step, scale = fit * zoom * (1 + 0.005 * step);
    const glm::dvec2 x = scale * glm::dvec2(std::cos(angle), std::sin(angle)), y(-x.y, x.x);
    const glm::dvec2 middle = 0.5 * glm::dvec2(view.width, view.height);
    view.toPixels = {x, y, middle - 0.5 * (scene.width * x + scene.height * y)};
    return view;
}

Contenders contenders(const Options& options, std::vector<std::string>& notes) {
    Contenders all;
    const auto add = [&](const std::vector<std::string>& commands, bool ours) {
        for (const std::string& command : commands)
            for (auto& engine : childEngines(command, notes))
                all.push_back({.engine = std::move(engine), .ours = ours});
    };
    add(ourCommands(options), true);
    add(peerCommands(options, notes), false);
    return all;
}

std::vector<std::string> engineCommands(const Options& options, std::vector<std::string>& notes) {
    std::vector<std::string> commands = ourCommands(options);
    std::ranges::copy(peerCommands(options, notes), std::back_inserter(commands));
    return commands;
}

const Contender& reference(const Contenders& all) {
    return *std::ranges::find_if(all.rbegin(), all.rend(), &Contender::ours);
}

void prepare(Contenders& all, const LoadedFile& picture, std::span<const Kind> kinds, const Options& options,
             std::vector<std::string>& notes) {
    const asset::View view = viewOf(picture.scene, options.side, {""}, 0);
    std::vector<image::Bitmap> drawn(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        all[i].able = true;
        did(all[i], picture.file.name, notes, [&] {
            all[i].engine->load(picture);
            drawn[i] = all[i].engine->pixels(view);
        });
        all[i].loads = all[i].able;
    }
    const auto ours = std::size_t(&reference(all) - all.data());
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i].difference = all[i].able && all[ours].able ? rmsDifference(drawn[i], drawn[ours]) : 0;
    if (options.pictures.empty())
        return;
    std::filesystem::create_directories(options.pictures);
    for (Contender& one : all)
        for (const Kind& kind : kinds)
            if (kind.moving && !kind.zooming)
                did(one, picture.file.name, notes,
                    [&] { writePicture(*one.engine, picture, kind, options); });
}

void takeTurns(Contenders& all, const LoadedFile& picture, const Kind& kind, int side,
               const Patience& patience, std::vector<std::string>& notes) {
    const std::string where = picture.file.name + ", " + kind.name;
    for (Contender& one : all) {
        one.times.clear();
        if (one.loads && !one.able) {  // it failed with other views
            one.able = true;
            did(one, where, notes, [&] { one.engine->load(picture); });
        }
    }
    double spent = 0;
    const int fewest = kind.zooming ? zoomRounds : patience.fewest,
              maximum = kind.zooming ? zoomRounds : patience.maximum;
    for (int round = -1; round < fewest || (spent < patience.budget && round < maximum); ++round) {
        const asset::View view = viewOf(picture.scene, side, kind, kind.moving ? std::max(round, 0) : 0);
        for (Contender& one : all) {
            std::optional<double> time;
            const auto draw = [&] {
                time = kind.cold ? one.engine->drawCold(picture, view) : one.engine->draw(view);
            };
            if (!did(one, where, notes, draw) || !time)
                continue;
            if (*time > patience.longest) {
                one.able = false;
                notes.push_back(
                    fmt::format("{}: {} takes {:.1f} s.", where, one.engine->name(), *time / 1000));
            } else if (round >= 0) {
                one.times.push_back(*time);
                spent += *time;
            }
        }
    }
}

}  // namespace vtm::bench
