// A cube of three pictures on a floor of one: textured_cube FOLDER OUT.png
//
// FOLDER holds the drawings beside this file. The floor repeats its tile up to the horizon, where a pixel is
// hundreds of times as long as wide; what a picture looks like in the light is the business of the shader
// below.

#include <cstdio>
#include <exception>

#include <glm/gtc/matrix_transform.hpp>

#include <vtm/gl/sampled_texture.hpp>
#include "examples/stage.hpp"

using namespace vtm;
using glm::vec3;

namespace {

constexpr const char* light = R"(
uniform vec3 eye;

// A lamp, a little gloss, and haze far away.
vec4 lit(vec4 c, float shade) {
    const vec3 lamp = vec3(2.6, 5.0, 3.4), haze = vec3(0.86, 0.89, 0.92);
    vec3 toLamp = normalize(lamp - place), toEye = normalize(eye - place), n = normalize(normal);
    float glint = pow(max(dot(n, normalize(toLamp + toEye)), 0.0), 60.0);
    vec3 rgb = c.rgb * (0.4 + 0.75 * max(dot(n, toLamp), 0.0) * shade) + 0.35 * glint * c.a * shade;
    return vec4(mix(rgb, haze * c.a, smoothstep(6.0, 40.0, distance(eye, place))), c.a);
}
)";

constexpr const char* faceShader = R"(
uniform Vtm face;
void main() { color = lit(vtm_sample(face, st), 1.0); }
)";

constexpr const char* floorShader = R"(
uniform Vtm tile;
void main() {
    // The cube stands on [-1, 1]² and keeps some light away.
    float away = length(max(abs(place.xz) - 1.0, 0.0));
    color = lit(vtm_sample(tile, st), mix(0.15, 1.0, smoothstep(-0.2, 1.1, away)));
}
)";

void drawScene(const std::string& folder, const std::string& out) {
    const gl::Context context;
    const asset::Asset front = stage::load(folder + "/lighthouse.svg"),
                       side = stage::load(folder + "/rose_window.svg"),
                       top = stage::load(folder + "/planet.svg"), tile = stage::load(folder + "/tiles.svg");
    gl::SampledTexture frontTexture(front), sideTexture(side), topTexture(top), tileTexture(tile);

    const GLuint faces =
        stage::program(gl::sampleInclude({front, side, top}), std::string(light) + faceShader);
    const GLuint floor = stage::program(gl::sampleInclude({tile}), std::string(light) + floorShader);

    stage::Canvas picture(960, 640, {0.86f, 0.89f, 0.92f});
    const vec3 eye(3.1f, 2.5f, 4.3f);
    const glm::mat4 camera = glm::perspective(glm::radians(38.0f), picture.aspect(), 0.1f, 500.0f) *
                             glm::lookAt(eye, vec3(0, 0.75f, 0), vec3(0, 1, 0));
    for (const GLuint program : {faces, floor}) {
        glUseProgram(program);
        glUniform3f(glGetUniformLocation(program, "eye"), eye.x, eye.y, eye.z);
    }

    tileTexture.bind(floor, "tile", 0, {asset::Wrap::Repeat, asset::Wrap::Repeat});
    stage::draw(floor, camera, {{-200, 0, -200}, {400, 0, 0}, {0, 0, 400}, {500, 500}});

    const gl::Wrapping clamped{asset::Wrap::Clamp, asset::Wrap::Clamp};
    frontTexture.bind(faces, "face", 0, clamped);
    stage::draw(faces, camera, {{-1, 2, 1}, {2, 0, 0}, {0, -2, 0}});
    sideTexture.bind(faces, "face", 0, clamped);
    stage::draw(faces, camera, {{1, 2, 1}, {0, 0, -2}, {0, -2, 0}});
    topTexture.bind(faces, "face", 0, clamped);
    stage::draw(faces, camera, {{-1, 2, -1}, {2, 0, 0}, {0, 0, 2}});
    picture.save(out);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fprintf(stderr, "usage: textured_cube FOLDER OUT.png\n");
        return 2;
    }
    try {
        drawScene(argv[1], argv[2]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "textured_cube: %s\n", error.what());
        return 1;
    }
    return 0;
}
