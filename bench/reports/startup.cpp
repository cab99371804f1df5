// What a program waits for before its first frame. Each start is a fresh process of this program.

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include <fmt/core.h>

#include <vtm/compiler/compile.hpp>
#include <vtm/gl/renderer.hpp>
#include "bench/input/files.hpp"
#include "bench/measure/measure.hpp"
#include "bench/reports/reports.hpp"

namespace vtm::bench {
namespace {

namespace fs = std::filesystem;

constexpr const char* steps[] = {"context", "renderer", "upload", "first frame", "second frame"};

/// How shaders' binaries are kept.
struct Start {
    const char* name;
    const char* environment;  ///< of Mesa; {} is its folder
    bool warm;                ///< that of a process before is used
    bool own;                 ///< RendererOptions::programCache
};
constexpr Start starts[] = {{"no cache", "MESA_SHADER_CACHE_DISABLE=true", false, false},
                            {"driver's cache, cold", "MESA_SHADER_CACHE_DIR='{}'", false, false},
                            {"driver's cache, warm", "MESA_SHADER_CACHE_DIR='{}'", true, false},
                            {"program cache, warm", "MESA_SHADER_CACHE_DIR='{}'", true, true}};

std::string outputOf(const std::string& command) {
    std::FILE* pipe = popen(command.c_str(), "r");
    if (!pipe)
        throw std::runtime_error("no process could be started");
    std::string text;
    for (char buffer[4096]; std::size_t count = std::fread(buffer, 1, sizeof buffer, pipe);)
        text.append(buffer, count);
    if (pclose(pipe) != 0)
        throw std::runtime_error("a process that starts afresh failed");
    return text;
}

Json timesOf(const Start& start, const File& file, const fs::path& folder, const Options& options) {
    const fs::path kept = folder / std::to_string(&start - starts), emptied = kept / "emptied";
    const fs::path& drivers =
        start.own ? emptied : kept;  // Mesa has binaries to keep only where it has a cache
    const auto run = [&] {
        fs::remove_all(emptied);
        fs::create_directories(emptied);
        return Json::parse(
            outputOf(fmt::format("{} '{}' start '{}' --only '{}' --side {}",
                                 fmt::format(fmt::runtime(start.environment), drivers.string()),
                                 options.program, start.own ? kept.string() : "", file.name, options.side)));
    };
    if (!start.warm)
        fs::remove_all(kept);
    else if (!fs::exists(kept))
        run();
    return run();
}

}  // namespace

void startOnce(const std::string& cache, const Options& options) {
    const File file = oneFileOf(options).at(0);
    const scene::Scene scene = load(file);
    const asset::Asset asset = compiler::compile(scene).asset;
    const double scale = options.side / std::max(scene.width, scene.height);
    const asset::View view{options.side, options.side, {scale, 0, 0, scale, 0, 0}};

    Json times;
    double last = wallMilliseconds();
    const auto lap = [&](const char* step) {
        const double now = wallMilliseconds();
        times[step] = now - last;
        last = now;
    };
    const gl::Context context;
    lap(steps[0]);
    gl::RendererOptions rendererOptions;
    rendererOptions.pixels = gl::Pixels::Shaders;
    rendererOptions.programCache = cache;
    gl::Renderer renderer(rendererOptions);
    lap(steps[1]);
    const gl::Texture texture = renderer.upload(asset);
    lap(steps[2]);
    renderer.draw(texture, view);
    lap(steps[3]);
    renderer.draw(texture, view);
    lap(steps[4]);
    times["programs"] = renderer.programs().made;
    times["compiled"] = renderer.programs().compiled;
    times["driver"] = context.renderer() + ", " + context.version();
    fmt::print("{}\n", times.dump());
}

Report startup(const Options& options) {
    Report report;
    report.name = "startup";
    report.title = "Starting";
    const fs::path folder = fs::temp_directory_path() / fmt::format("vtm_bench_start_{}", getpid());
    const int rounds = options.quick ? 5 : 15;
    for (const File& file : oneFileOf(options)) {
        std::vector<std::vector<Json>> all(std::size(starts));
        for (int round = 0; round < rounds; ++round)
            for (std::size_t i = 0; i < all.size(); ++i)
                all[i].push_back(timesOf(starts[i], file, folder, options));
        report.text = fmt::format(
            "Wall milliseconds in fresh processes that took turns: {}'s asset is at hand, then an EGL "
            "context is made, a "
            "renderer, the asset uploaded, and two frames drawn by shaders, {} pixels wide, the first of "
            "which "
            "compiles the programs. Medians of {}; quartiles of all but the second frame. Mesa's cache of "
            "shaders is "
            "off, empty, or filled by a process before; `program cache` is RendererOptions::programCache. On "
            "{}.",
            file.name, options.side, rounds, all[0][0]["driver"].get<std::string>());
        for (std::size_t i = 0; i < all.size(); ++i) {
            Json row = {{"start", starts[i].name}};
            std::vector<double> sums(all[i].size());
            for (const char* step : steps) {
                std::vector<double> each;
                for (const Json& times : all[i])
                    each.push_back(times[step]);
                row[step] = median(each);
                for (std::size_t k = 0; k < each.size() && step != steps[4]; ++k)
                    sums[k] += each[k];
            }
            row["to first frame"] = median(sums);
            row["quartiles"] = fmt::format("{:.3g}-{:.3g}", quantile(sums, 0.25), quantile(sums, 0.75));
            row["programs"] = all[i][0]["programs"];
            row["compiled"] = all[i][0]["compiled"];
            report.rows.push_back(std::move(row));
        }
    }
    fs::remove_all(folder);
    return report;
}

}  // namespace vtm::bench
