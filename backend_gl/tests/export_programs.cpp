// export_programs FOLDER: writes every program as NUMBER_NAME.vert and .frag, for other compilers to read:
// the renderers', filters', ids' and paper mode's, and programs of one sample each with every kind of
// include.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "asset/testing.hpp"
#include "backend_gl/core/programs.hpp"
#include "backend_gl/texture/prefilter_texture.hpp"
#include "backend_gl/texture/sample_include.hpp"
#include "paper/gl/programs.hpp"

namespace {

using namespace vtm;

struct Stages {
    std::string name, vertex, fragment;
};

constexpr const char* wholeTarget = R"(#version 300 es
void main() { gl_Position = vec4(float(gl_VertexID & 1) * 4.0 - 1.0, float(gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0); }
)";
constexpr const char* oneSample = R"(
uniform Vtm picture;
out vec4 color;
void main() { color = vtm_sample(picture, gl_FragCoord.xy / 16.0); }
)";

Stages sampling(unsigned features, gl::SampledKinds kinds) {
    const std::vector<asset::Material> materials = asset::test::everyPaint().materials;
    return {"sample", wholeTarget,
            "#version 300 es\n" + gl::sampleText(gl::Features(features), kinds, materials) + oneSample};
}

/// Whose pyramids of means the CPU makes.
constexpr unsigned withoutMeans = gl::Features::Image | gl::Features::Material;

std::vector<Stages> everyProgram() {
    std::vector<Stages> programs;
    const auto add = [&](const gl::ProgramSource& source) {
        programs.push_back({source.name, gl::joined(source.vertex), gl::joined(source.fragment)});
    };
    for (const gl::ProgramSource& source : gl::Programs::everySource())
        add(source);
    for (const gl::ProgramSource& source : paper::everySource())
        add(source);
    for (unsigned features = 0; features < gl::Features::combinations; ++features)
        programs.push_back(sampling(features, {0, false}));
    for (const unsigned features : {0u, gl::Features::combinations - 1})
        for (unsigned innerMaps = 0; innerMaps < asset::maxMapDepth; ++innerMaps)
            for (const bool pages : {false, true}) {
                programs.push_back(sampling(features, {innerMaps, pages}));
                add(gl::meanSource(gl::Features(features & ~withoutMeans), {innerMaps, pages}));
            }
    add(gl::coarserSource());
    return programs;
}

void write(const std::filesystem::path& path, const std::string& text) {
    std::ofstream file(path);
    file << text;
    file.close();
    if (!file)
        throw std::runtime_error(path.string() + ": cannot be written");
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc != 2)
        throw std::runtime_error("usage: export_programs FOLDER");
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    unsigned number = 0;
    for (const Stages& program : everyProgram()) {
        const std::string stem = fmt::format("{:04}_{}", number++, program.name);
        write(folder / (stem + ".vert"), program.vertex);
        write(folder / (stem + ".frag"), program.fragment);
    }
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "export_programs: %s\n", error.what());
    return 1;
}
