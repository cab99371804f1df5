#include <fmt/core.h>

#include "bench/src/measure.hpp"
#include "bench/src/reports.hpp"
#include "compiler/compile.hpp"

#ifdef VTM_HAVE_RSVG
#include <cairo.h>
#include <librsvg/rsvg.h>
#endif

namespace vtm::bench {
namespace {

constexpr int width = 1024;      ///< pixels
constexpr double budget = 4000;  ///< CPU milliseconds a file
constexpr int mostPairs = 41;

#ifdef VTM_HAVE_RSVG

/// A parsed file, drawn by librsvg with cairo in memory.
class Rsvg {
public:
    explicit Rsvg(const std::filesystem::path& path)
        : handle_(rsvg_handle_new_from_file(path.c_str(), nullptr)) {}
    ~Rsvg() {
        if (handle_)
            g_object_unref(handle_);
    }
    Rsvg(const Rsvg&) = delete;
    Rsvg& operator=(const Rsvg&) = delete;

    bool loaded() const { return handle_ != nullptr; }

    /// Once, `width` pixels wide.
    bool draw(double aspect) const {
        const int height = std::max(1, int(aspect * width + 0.5));
        cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height);
        cairo_t* cairo = cairo_create(surface);
        const RsvgRectangle viewport{0, 0, double(width), double(height)};
        const bool drawn = rsvg_handle_render_document(handle_, cairo, &viewport, nullptr);
        cairo_surface_flush(surface);
        cairo_destroy(cairo);
        cairo_surface_destroy(surface);
        return drawn;
    }

private:
    RsvgHandle* handle_;
};

void addFile(const File& file, Report& report) {
    const scene::Scene scene = load(file);
    const Rsvg rsvg(file.path);
    if (!rsvg.loaded() || !rsvg.draw(scene.height / scene.width)) {
        report.notes.push_back(file.name + ": librsvg cannot draw it.");
        return;
    }
    const auto draw = [&] { rsvg.draw(scene.height / scene.width); };
    const Paired time = pairwise(
        draw, [&] { compiler::compile(scene); }, budget, mostPairs);
    const asset::Summary summary = asset::summarize(compiler::compile(scene).asset);
    report.rows.push_back({{"file", file.name},
                           {"librsvg ms", time.first},
                           {"encode ms", time.second},
                           {"encode / librsvg", time.ratio},
                           {"quartiles", fmt::format("{:.3g}-{:.3g}", time.low, time.high)},
                           {"pairs", time.pairs},
                           {"asset bytes", summary.bytes},
                           {"pieces", summary.pieces}});
}

std::string versionOfPeer() {
    return fmt::format("librsvg {}.{}.{}", LIBRSVG_MAJOR_VERSION, LIBRSVG_MINOR_VERSION,
                       LIBRSVG_MICRO_VERSION);
}

#else

void addFile(const File& file, Report& report) {
    const scene::Scene scene = load(file);
    std::vector<double> times;
    for (int i = 0; i < 5; ++i)
        times.push_back(cpuTime([&] { compiler::compile(scene); }));
    const asset::Summary summary = asset::summarize(compiler::compile(scene).asset);
    report.rows.push_back({{"file", file.name},
                           {"encode ms", median(times)},
                           {"asset bytes", summary.bytes},
                           {"pieces", summary.pieces}});
}

std::string versionOfPeer() { return "librsvg, which is missing here (librsvg2-dev),"; }

#endif

}  // namespace

Report peers(const std::vector<File>& files) {
    Report report;
    report.name = "peers";
    report.title = "Encoding against drawing once";
    report.text =
        versionOfPeer() +
        " draws each file once, 1024 pixels wide, from a parsed handle; we encode it from a scene in "
        "memory, with the default options. CPU time of all threads, the two taking turns: medians, and the "
        "median and the quartiles of the ratios pair by pair.";
    for (const File& file : files)
        addFile(file, report);
    return report;
}

}  // namespace vtm::bench
