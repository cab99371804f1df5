// An SVG drawing through vgDrawPath: vg_tiger DRAWING.svg OUT.png|window [DEGREES [ZOOM]]
//
// Paths and paints are made once. What changes from frame to frame is one matrix, and in a window it turns.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include <glm/trigonometric.hpp>

#include <vtm/image/codec.hpp>
#include <vtm/svg/load.hpp>
#include "examples/openvg/drawing.hpp"
#include "examples/openvg/stage.hpp"

using namespace vtm;

namespace {

constexpr int size = 720;
constexpr double margin = 24;

scene::Affine rotation(double degrees) {
    const double a = glm::radians(degrees);
    return {std::cos(a), std::sin(a), -std::sin(a), std::cos(a), 0, 0};
}

/// The whole drawing in the middle of the surface. OpenVG's y runs up, the drawing's down.
scene::Affine fitted(const drawing::Drawing& drawing, double degrees, double zoom) {
    const double scale = zoom * (size - 2 * margin) / std::max(drawing.width(), drawing.height());
    const scene::Affine centred = scene::translation(-drawing.width() / 2, -drawing.height() / 2);
    return scene::compose(
        scene::translation(size / 2.0, size / 2.0),
        scene::compose(rotation(degrees), scene::compose(scene::scaling(scale, -scale), centred)));
}

void draw(const std::string& file, const std::string& target, double degrees, double zoom) {
    svg::Options options;
    options.fileName = file;
    const svg::Document document = svg::load(image::readFile(file), options);
    const auto stage = stage::open(target, size, size, "Tiger");
    drawing::Drawing drawing(document.scene);
    std::printf("%d paths", drawing.paths());
    std::printf(drawing.leftOut() > 0 ? ", %d things left out\n" : "\n", drawing.leftOut());

    const VGfloat paper[] = {0.98f, 0.96f, 0.91f, 1};
    vgSetfv(VG_CLEAR_COLOR, 4, paper);
    stage->show(0, [&](double seconds) {
        vgClear(0, 0, size, size);
        drawing.draw(fitted(drawing, degrees + 12 * seconds, zoom), size, size);
    });
}

}  // namespace

int main(int argc, char** argv) {
    return stage::run([&] {
        if (argc < 3 || argc > 5)
            throw std::runtime_error("usage: vg_tiger DRAWING.svg OUT.png|window [DEGREES [ZOOM]]");
        draw(argv[1], argv[2], argc > 3 ? std::atof(argv[3]) : 0, argc > 4 ? std::atof(argv[4]) : 1);
    });
}
