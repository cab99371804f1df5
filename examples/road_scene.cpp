// A road to the horizon, between signs and trees that are textures with nothing around them: road_scene
// FOLDER OUT.png
//
// The pictures' outlines are the shapes that we see: where a picture is clear, the fragment is discarded, and
// its depth with it; along the outline the share of the pixel is the fragment's alpha. So what is far is
// drawn first.

#include <cstdio>
#include <exception>

#include <glm/gtc/matrix_transform.hpp>

#include <vtm/gl/sampled_texture.hpp>
#include "examples/stage.hpp"

using namespace vtm;
using glm::vec3;

namespace {

/// An evening: a low sun, and haze that swallows the far end of the road.
constexpr const char* evening = R"(
vec4 inHaze(vec4 c) {
    const vec3 sun = vec3(1.04, 0.97, 0.86), haze = vec3(0.97, 0.86, 0.74);
    float near = exp(-0.0065 * max(-place.z - 8.0, 0.0));
    return vec4(mix(haze * c.a, c.rgb * sun, near), c.a);
}
)";

constexpr const char* groundShader = R"(
uniform Vtm ground;
void main() { color = inHaze(vtm_sample(ground, st)); }
)";

constexpr const char* meadowShader = R"(
void main() {
    float patches = sin(place.x * 0.07) * sin(place.z * 0.05) + 0.5 * sin(place.x * 0.21 + place.z * 0.13);
    color = inHaze(vec4(mix(vec3(0.52, 0.62, 0.33), vec3(0.62, 0.67, 0.38), 0.5 + 0.4 * patches), 1.0));
}
)";

constexpr const char* skyShader = R"(
void main() {
    vec3 c = mix(vec3(0.47, 0.66, 0.83), vec3(0.97, 0.86, 0.74), pow(st.t, 1.6));
    color = vec4(mix(c, vec3(1.0, 0.95, 0.8), 0.8 * exp(-60.0 * dot(st - vec2(0.54, 0.95), st - vec2(0.54, 0.95)))), 1.0);
}
)";

/// What stands: a picture is its own outline.
constexpr const char* standingShader = R"(
uniform Vtm shape;
void main() {
    vec4 c = vtm_sample(shape, st);
    if (c.a < 1.0 / 255.0)
        discard;
    color = inHaze(c);
}
)";

/// A picture `height` metres high that stands at (x, z), facing us.
stage::Quad standing(float x, float z, float height, float aspect) {
    const float width = height * aspect;
    return {{x - width / 2, height, z}, {width, 0, 0}, {0, -height, 0}};
}

void drawScene(const std::string& folder, const std::string& out) {
    const gl::Context context;
    const asset::Asset road = stage::load(folder + "/road.svg"), tree = stage::load(folder + "/tree.svg"),
                       bend = stage::load(folder + "/bend.svg"), limit = stage::load(folder + "/limit.svg");
    gl::SampledTexture roadTexture(road), treeTexture(tree), bendTexture(bend), limitTexture(limit);

    const std::string plain = "precision highp float;\n";
    const GLuint sky = stage::program(plain, skyShader),
                 meadow = stage::program(plain, std::string(evening) + meadowShader),
                 ground = stage::program(gl::sampleInclude({road}), std::string(evening) + groundShader),
                 shapes = stage::program(gl::sampleInclude({tree, bend, limit}),
                                         std::string(evening) + standingShader);

    stage::Canvas picture(960, 600, {0.97f, 0.86f, 0.74f});
    const glm::mat4 camera = glm::perspective(glm::radians(42.0f), picture.aspect(), 0.1f, 4000.0f) *
                             glm::lookAt(vec3(1.1f, 1.5f, 4), vec3(0.2f, 1.9f, -30), vec3(0, 1, 0));

    stage::draw(sky, glm::mat4(1), {{-1, 1, 0.9999f}, {2, 0, 0}, {0, -1.1f, 0}});
    stage::draw(meadow, camera, {{-2000, -0.02f, -3000}, {4000, 0, 0}, {0, 0, 3010}});
    roadTexture.bind(ground, "ground", 0, {asset::Wrap::Border, asset::Wrap::Repeat});
    stage::draw(ground, camera, {{-4, 0, -3000}, {8, 0, 0}, {0, 0, 3012}, {1, 251}});

    for (int i = 40; i >= 0; --i) {
        const float z = -12.0f * float(i) - 14;
        treeTexture.bind(shapes, "shape", 0);
        stage::draw(shapes, camera, standing(-9 - float(i % 3), z, 8 + float(i * 7 % 3), 0.6f));
        stage::draw(shapes, camera, standing(10 + float(i * 5 % 4), z - 4, 7 + float(i * 5 % 3), 0.6f));
        if (i % 3 == 0) {
            gl::SampledTexture& sign = i % 2 == 0 ? bendTexture : limitTexture;
            sign.bind(shapes, "shape", 0);
            stage::draw(shapes, camera, standing(4.9f, z + 4, 2.9f, 100.0f / 220));
        }
    }
    picture.save(out);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fprintf(stderr, "usage: road_scene FOLDER OUT.png\n");
        return 2;
    }
    try {
        drawScene(argv[1], argv[2]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "road_scene: %s\n", error.what());
        return 1;
    }
    return 0;
}
