// A thousand stars that turn and drift, none of them compiled again: star_swarm FOLDER OUT.png
//
// FOLDER holds the drawings beside this file. The last of a few frames is written; how many bytes each took
// is printed.

#include <cmath>
#include <cstdio>
#include <exception>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat2x2.hpp>

#include <vtm/asset/placements.hpp>
#include <vtm/gl/sampled_texture.hpp>
#include "examples/stage.hpp"

using namespace vtm;
using glm::dvec2;

namespace {

constexpr int columns = 40, rows = 25, frames = 8;

/// Each about the middle of a square of its own, so that no two meet.
std::vector<asset::Placement> starsAt(double time, const asset::Asset& sky, const asset::Placement& star,
                                      double size) {
    std::vector<asset::Placement> stars;
    const dvec2 step = dvec2(sky.width, sky.height) / dvec2(columns, rows);
    for (int i = 0; i < columns * rows; ++i) {
        const double phase = 2.4 * i, angle = time + phase,
                     scale = 0.3 * step.y / size * (1 + 0.4 * std::sin(phase + time));
        const dvec2 middle = step * (dvec2(i % columns, i / columns) + 0.5 +
                                     0.15 * dvec2(std::cos(time + phase), std::sin(0.7 * time + phase)));
        const glm::dmat2 turn =
            scale * glm::dmat2(std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle));
        asset::Placement moved = star;
        moved.toPicture = glm::dmat3x2(turn * star.toPicture[0], turn * star.toPicture[1],
                                       turn * (star.toPicture[2] - 0.5 * size) + middle);
        if (i % 3 == 0)
            std::swap(moved.paints[1], moved.paints.back());
        stars.push_back(std::move(moved));
    }
    return stars;
}

void drawSwarm(const std::string& folder, const std::string& out) {
    const gl::Context context;
    asset::Asset sky = stage::load(folder + "/night.svg");
    const asset::Asset drawing = stage::load(folder + "/star.svg");
    asset::Placement star = asset::addPicture(sky, drawing);
    star.paints[0] = 1;  // the sky's only colour
    const auto frameAt = [&](double time) {
        return asset::withPlacements(sky, starsAt(time, sky, star, drawing.width));
    };
    asset::Asset frame = frameAt(0);
    gl::SampledTexture texture(frame);
    const GLuint program = stage::program(gl::sampleInclude({frame}), R"(
uniform Vtm sky;
void main() { color = vtm_sample(sky, st); })");
    stage::Canvas picture(960, 600, {0, 0, 0});
    for (int i = 0; i <= frames; ++i) {
        frame = frameAt(0.1 * i);
        std::printf("frame %d: %zu bytes\n", i, texture.update(frame, false));
        texture.bind(program, "sky", 0);
        stage::draw(program, glm::mat4(1), {{-1, 1, 0}, {2, 0, 0}, {0, -2, 0}});
    }
    picture.save(out);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fprintf(stderr, "usage: star_swarm FOLDER OUT.png\n");
        return 2;
    }
    try {
        drawSwarm(argv[1], argv[2]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "star_swarm: %s\n", error.what());
        return 1;
    }
    return 0;
}
