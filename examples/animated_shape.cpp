// A shape that changes: animated_shape OUT.png
//
// Every frame is a picture of its own, compiled and made a texture when its turn comes, so it is exact at any
// size like any other; the shader gives it its ink. Eight frames side by side.

#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include <vtm/compiler/compile.hpp>
#include <vtm/gl/sampled_texture.hpp>
#include "examples/stage.hpp"

using namespace vtm;

namespace {

constexpr int frames = 8, columns = 4, framePixels = 240;
constexpr double side = 100;  // of a frame, units

/// r = 30 + swing · cos(5θ) round the centre, as cubics through `corners` points with the curve's tangents
/// there.
scene::Path blossom(double swing, double turn) {
    constexpr int corners = 40;
    constexpr double step = 2 * std::numbers::pi / corners;
    const auto at = [&](double angle) {
        const double r = 30 + swing * std::cos(5 * angle);
        return side / 2 + r * scene::Point(std::cos(angle + turn), std::sin(angle + turn));
    };
    const auto tangent = [&](double angle) { return (at(angle + 1e-4) - at(angle - 1e-4)) / 2e-4; };
    scene::Path path{scene::MoveTo{at(0)}};
    for (int i = 0; i < corners; ++i) {
        const double from = i * step, to = from + step;
        path.push_back(
            scene::CubicTo{at(from) + tangent(from) * (step / 3), at(to) - tangent(to) * (step / 3), at(to)});
    }
    path.push_back(scene::Close{});
    return path;
}

asset::Asset frame(int index) {
    const double phase = 2 * std::numbers::pi * index / frames;
    scene::Item item;
    item.path = std::make_shared<scene::Path>(blossom(16 * std::cos(phase), 0.4 * phase));
    item.geometry = scene::FillRule::NonZero;
    item.paint = scene::Color{1, 1, 1, 1};
    scene::Scene picture;
    picture.width = picture.height = side;
    picture.root.children.push_back({item});
    return compiler::compile(picture).asset;
}

constexpr const char* inkShader = R"(
uniform Vtm shape;
uniform vec3 ink;
void main() {
    float covered = vtm_sample(shape, st).a;
    color = vec4(mix(vec3(1.0, 0.98, 0.95), ink, covered), 1.0);
}
)";

void drawScene(const std::string& out) {
    const gl::Context context;
    stage::Canvas picture(columns * framePixels, frames / columns * framePixels, {1, 1, 1});
    const glm::mat4 flat = glm::ortho(0.0f, float(columns), float(frames / columns), 0.0f);
    const GLuint program =
        stage::program(gl::sampleInclude({asset::Asset()}), inkShader);  // solid colours only
    glUseProgram(program);
    for (int i = 0; i < frames; ++i) {
        gl::SampledTexture texture(frame(i));
        texture.bind(program, "shape", 0);
        const float warm = 0.5f + 0.5f * std::cos(2 * std::numbers::pi_v<float> * float(i) / frames);
        glUniform3f(glGetUniformLocation(program, "ink"), 0.25f + 0.6f * warm, 0.3f, 0.65f - 0.3f * warm);
        stage::draw(program, flat, {{i % columns, i / columns, 0}, {1, 0, 0}, {0, 1, 0}});
    }
    picture.save(out);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: animated_shape OUT.png\n");
        return 2;
    }
    try {
        drawScene(argv[1]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "animated_shape: %s\n", error.what());
        return 1;
    }
    return 0;
}
