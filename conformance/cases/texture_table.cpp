// Prints the figures of pictures sampled as textures (docs/texture.md).
// texture_table [NAME...]: errors in 1/255 and processor time beside the picture's own renderer.
// texture_table --zoom OUT.json [NAME...]: the continuous zoom, for bench/plot.py.

#include <algorithm>
#include <cmath>
#include <ctime>
#include <exception>
#include <functional>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <vtm/image/codec.hpp>
#include "backend_gl/testing.hpp"
#include "conformance/cases/support.hpp"
#include "conformance/cases/texture_views.hpp"
#include "conformance/compare/compare.hpp"

namespace {

using namespace vtm;
using namespace vtm::cases;

struct Case {
    explicit Case(const std::string& name, Gl& gl)
        : measured(name),
          texture(measured.asset()),
          renderer(gl.renderer),
          uploaded(renderer.upload(measured.asset())) {}

    image::Raster exact(const asset::View& view) const { return exactMeans(measured.asset(), view); }
    image::Raster drawn(const asset::View& view) { return renderer.render(uploaded, view); }
    double rms(const asset::View& view) { return compare::compare(texture.draw(view), exact(view)).rms; }
    glm::dvec2 size() const { return {measured.scene().width, measured.scene().height}; }

    Measurement measured;
    gl::test::TextureCanvas texture;
    gl::Renderer& renderer;
    gl::Texture uploaded;
};

/// Milliseconds of processor time, all threads, best of three.
double milliseconds(const std::function<void()>& work) {
    double best = 1e9;
    for (int i = 0; i < 3; ++i) {
        const std::clock_t start = std::clock();
        work();
        best = std::min(best, 1000.0 * double(std::clock() - start) / CLOCKS_PER_SEC);
    }
    return best;
}

double floorRms(Case& picture, const Floor& floor) {
    constexpr int samples = 8;
    const gl::Wrapping repeated{asset::Wrap::Repeat, asset::Wrap::Repeat};
    const auto fine = picture.texture.draw(floor.toPicture(samples), floor.width * samples,
                                           floor.height * samples, repeated);
    return compare::compare(picture.texture.draw(floor.toPicture(1), floor.width, floor.height, repeated),
                            averaged(fine, samples))
        .rms;
}

void printRow(const CorpusFile& file, Gl& gl) {
    Case picture(file.name, gl);
    std::string row = fmt::format("{:<14}", file.name);
    for (const int size : {1024, 64})
        row += file.limits.empty()
                   ? fmt::format(" {:>7}", "-")
                   : fmt::format(" {:7.4f}", compare::compare(asWritten(picture.texture.draw(wholePicture(
                                                                  picture.measured.scene(), size))),
                                                              truthOf(file.name, size))
                                                 .mean);
    for (const int size : {1024, 256, 128, 64, 32})
        row += fmt::format(" {:6.3f}", picture.rms(wholePicture(picture.measured.scene(), size)));
    for (const Floor& floor : {mildFloor, steepFloor})
        row += fmt::format(" {:6.2f}", floorRms(picture, floor));
    for (const double pixels : {4096.0, 1024.0, 256.0}) {
        const asset::View view = turned(picture.size(), 1024, pixels, 0.3);
        const double drawn = milliseconds([&] { picture.drawn(view); }),
                     sampled = milliseconds([&] { picture.texture.draw(view); });
        row += fmt::format(" {:6.2f}", sampled / drawn);
    }
    fmt::print("{}\n", row);
    std::fflush(stdout);
}

double rounded(double v) { return std::round(v * 1e4) / 1e4; }

void writeZoom(const std::string& path, const std::vector<CorpusFile>& files, Gl& gl) {
    std::string text = "{\"rows\": [";
    const char* separator = "\n";
    for (const CorpusFile& file : files) {
        Case picture(file.name, gl);
        for (const ZoomFrame& frame : zoomed(
                 picture.size(), [&](const asset::View& view) { return picture.texture.draw(view); },
                 [&](const asset::View& view) { return picture.exact(view); })) {
            const nlohmann::json row = {{"file", file.name},
                                        {"px", rounded(frame.pixels)},
                                        {"error", rounded(frame.error)},
                                        {"change", rounded(frame.change)}};
            text += separator + row.dump();
            separator = ",\n";
        }
    }
    text += "\n]}\n";
    image::writeFile(path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<std::string> names(argv + 1, argv + argc);
    const bool zoom = names.size() > 1 && names[0] == "--zoom";
    const std::string path = zoom ? names[1] : "";
    names.erase(names.begin(), names.begin() + (zoom ? 2 : 0));
    try {
        Gl gl;
        std::vector<CorpusFile> files = corpusFiles();
        std::erase_if(files, [&](const CorpusFile& file) {
            return !names.empty() && std::find(names.begin(), names.end(), file.name) == names.end();
        });
        if (zoom) {
            writeZoom(path, files, gl);
            return 0;
        }
        fmt::print(
            "{}\n{:<14} {:^15} {:^34} {:^13} {:^20}\n{:<14} {:>7} {:>7} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} "
            "{:>6} {:>6} {:>6} {:>6}\n",
            gl.context.renderer(), "errors in 1/255", "mean to truth", "rms to picture, pixels", "rms, floor",
            "time : picture's", "file", 1024, 64, 1024, 256, 128, 64, 32, "4 : 1", "16 : 1", 4096, 1024, 256);
        for (const CorpusFile& file : files)
            printRow(file, gl);
    } catch (const std::exception& error) {
        fmt::print(stderr, "texture_table: {}\n", error.what());
        return 1;
    }
    return 0;
}
