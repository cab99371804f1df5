// A drawing through vgDrawPath, recorded as one picture: vg_record DRAWING.svg OUT.vtm OUT.png|window
// [DEGREES [ZOOM]]
//
// The calls are made once. What they would draw becomes a Vector Texture Map, which is written to a file and
// drawn under a matrix from then on: one call a frame, exact at any zoom, without seams between shapes that
// abut.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>

#include <vtm/vg.h>

#include <vtm/image/codec.hpp>
#include <vtm/svg/load.hpp>
#include "examples/openvg/drawing.hpp"
#include "examples/openvg/stage.hpp"

using namespace vtm;

namespace {

constexpr int size = 720;
constexpr double margin = 24;

using Recording = std::unique_ptr<VtmRecording, decltype(&vtmDestroyRecording)>;

/// With the drawing's lower left corner at the origin.
Recording record(drawing::Drawing& drawing) {
    const double width = drawing.width(), height = drawing.height();
    vtmBeginRecording(VGfloat(width), VGfloat(height));
    drawing.draw({1, 0, 0, -1, 0, height}, int(width) + 1, int(height) + 1);
    Recording recording(vtmEndRecording(), vtmDestroyRecording);
    if (!recording)
        throw std::runtime_error(std::string("not recorded: ") + vtmGetRecordingFault());
    return recording;
}

void write(const VtmRecording* recording, const std::string& file) {
    std::size_t count = 0;
    const auto* bytes = static_cast<const std::uint8_t*>(vtmGetRecordingBytes(recording, &count));
    image::writeFile(file, {bytes, count});
    std::printf("%s: %zu bytes\n", file.c_str(), count);
}

/// In the middle of the surface.
void draw(const VtmRecording* recording, double degrees, double zoom) {
    const VGfloat width = vtmRecordingWidth(recording), height = vtmRecordingHeight(recording);
    const auto scale = VGfloat(zoom * (size - 2 * margin)) / std::max(width, height);
    vgSeti(VG_MATRIX_MODE, VG_MATRIX_PATH_USER_TO_SURFACE);
    vgLoadIdentity();
    vgTranslate(size / 2, size / 2);
    vgRotate(VGfloat(degrees));
    vgScale(scale, scale);
    vgTranslate(-width / 2, -height / 2);
    vtmDrawRecording(recording);
}

void show(const std::string& file, const std::string& output, const std::string& target, double degrees,
          double zoom) {
    svg::Options options;
    options.fileName = file;
    const svg::Document document = svg::load(image::readFile(file), options);
    const auto stage = stage::open(target, size, size, "A recording");
    Recording recording(nullptr, vtmDestroyRecording);
    {
        drawing::Drawing drawing(document.scene);
        recording = record(drawing);
    }
    write(recording.get(), output);

    const VGfloat paper[] = {0.98f, 0.96f, 0.91f, 1};
    vgSetfv(VG_CLEAR_COLOR, 4, paper);
    stage->show(0, [&](double seconds) {
        vgClear(0, 0, size, size);
        draw(recording.get(), degrees + 12 * seconds, zoom);
    });
}

}  // namespace

int main(int argc, char** argv) {
    return stage::run([&] {
        if (argc < 4 || argc > 6)
            throw std::runtime_error("usage: vg_record DRAWING.svg OUT.vtm OUT.png|window [DEGREES [ZOOM]]");
        show(argv[1], argv[2], argv[3], argc > 4 ? std::atof(argv[4]) : 0, argc > 5 ? std::atof(argv[5]) : 1);
    });
}
