#include "backend_gl/core/programs.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>

#include <glm/common.hpp>

#include <fmt/format.h>

#include "asset/testing.hpp"
#include "backend_gl/core/gl.hpp"
#include "backend_gl/layers/layer_renderer.hpp"
#include "backend_gl/tests/gl_fixture.hpp"
#include "paper/gl/programs.hpp"
#include "raster/testing_views.hpp"
#include "tests/test_folder.hpp"

namespace vtm::gl {

namespace {

using namespace asset::test;

// ---- Every permutation ----------------------------------------------------------------------------

/// WebGL 2's least limits (GLSL ES 3.00's, OpenGL ES 3.0 table 6.32).
constexpr int minUniformVectors = 224, minVaryingVectors = 15, minTextureUnits = 16;

struct UniformCost {
    int vectors = 0, textures = 0;
};

UniformCost costOf(const Program& program) {
    UniformCost cost;
    GLint count = 0;
    glGetProgramiv(program.name(), GL_ACTIVE_UNIFORMS, &count);
    for (GLuint i = 0; i < GLuint(count); ++i) {
        char name[256];
        GLint size = 0;
        GLenum type = 0;
        glGetActiveUniform(program.name(), i, sizeof(name), nullptr, &size, &type, name);
        if (type == GL_SAMPLER_2D || type == GL_UNSIGNED_INT_SAMPLER_2D)
            cost.textures += size;
        else
            cost.vectors += size * (type == GL_FLOAT_MAT2 ? 2 : 1);
    }
    return cost;
}

/// Declarations of inputs that the vertex stage writes, a vector each: none is a matrix or an array.
int varyingsOf(const ProgramSource& source) {
    static const std::regex declaration(R"((^|\n)\s*(flat\s+)?in\s+u?i?(vec\d|float|int|uint|bool)\s+\w+;)");
    const std::string text = joined(source.fragment);
    return int(std::distance(std::sregex_iterator(text.begin(), text.end(), declaration), {}));
}

/// Of this module and of paper mode.
std::vector<ProgramSource> everySource() {
    std::vector<ProgramSource> sources = Programs::everySource();
    for (ProgramSource& source : paper::everySource())
        sources.push_back(std::move(source));
    return sources;
}

/// On this driver a sample of them; all are validated below.
TEST_F(Gl, EveryPermutationCompilesWithinTheLeastLimits) {
    const std::vector<ProgramSource> sources = everySource();
    ASSERT_GT(sources.size(), 300u);
    const std::size_t step = std::getenv("VTM_TEST_ALL") ? 1 : 3;
    int varyings = 0;
    for (std::size_t i = 0; i < sources.size(); ++i) {
        const ProgramSource& source = sources[i];
        varyings = std::max(varyings, varyingsOf(source));
        if (i % step != 0)
            continue;
        SCOPED_TRACE(joined(source.fragment).substr(0, 400) + source.name);
        const Program program(source);
        const UniformCost cost = costOf(program);
        EXPECT_LE(cost.vectors, minUniformVectors);
        EXPECT_LE(cost.textures, minTextureUnits);
    }
    // Those of tiles (place.glsl, shadow.glsl, tile_fragment.glsl): declarations are counted.
    EXPECT_EQ(varyings, 6);
    EXPECT_LE(varyings, minVaryingVectors);
}

/// A strict reader that is nobody's driver.
TEST_F(Gl, EveryPermutationIsGlslEs300ByTheReferenceCompiler) {
    if (std::system("glslangValidator --version > /dev/null 2>&1") != 0)
        GTEST_SKIP() << "glslangValidator is not installed";
    const TestFolder folder;
    std::set<std::string> written;
    const auto write = [&](const std::vector<std::string>& parts, const char* stage) {
        const std::string text = joined(parts);
        if (written.insert(text).second)
            std::ofstream(folder / (std::to_string(written.size()) + stage)) << text;
    };
    for (const ProgramSource& source : everySource()) {
        write(source.vertex, ".vert");
        write(source.fragment, ".frag");
    }
    const std::string log = (folder / "log").string();
    const std::string command = "glslangValidator " + (folder / "*.vert").string() + " " +
                                (folder / "*.frag").string() + " > " + log + " 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << std::ifstream(log).rdbuf();
    // It must be able to say no.
    std::ofstream(folder / "wrong.frag") << joined(everySource()[0].fragment) + "\nfloat f = 1;\n";
    EXPECT_NE(
        std::system(("glslangValidator " + (folder / "wrong.frag").string() + " > /dev/null 2>&1").c_str()),
        0);
}

TEST_F(Gl, CompileErrorsCarryTheDriversLog) {
    try {
        Program(ProgramSource("broken", {"void main() { gl_Position = vec4(0.0); }"},
                              {"out vec4 c;\nvoid main() { c = nonsense; }"}));
        ADD_FAILURE();
    } catch (const GlError& error) {
        EXPECT_NE(std::string(error.what()).find("fragment shader of program broken"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("nonsense"), std::string::npos);
    }
}

/// Into an RGBA8 framebuffer.
class WarmUp : public Gl {
protected:
    void SetUp() override {
        Gl::SetUp();
        if (!context)
            return;
        target = makeTexture(GL_RGBA8, 40, 40);
        framebuffer = makeFramebuffer();
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.get());
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.get(), 0);
    }

    TextureHandle target;
    FramebufferHandle framebuffer;
};

TEST_F(WarmUp, LeavesNothingToCompileForTheFirstPicture) {
    RendererOptions options;
    options.pixels = Pixels::Shaders;
    Output linear, over;
    linear.encoding = Output::Encoding::Linear;
    over.write = Output::Write::Over;
    for (const asset::Asset& asset : {disc(), layers(), everyPaint()})
        for (const Output& output : {Output(), linear, over}) {
            Renderer fresh(options);
            const Texture texture = fresh.upload(asset);
            const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(2);
            while (!fresh.warmUp(texture, output))
                ASSERT_LT(std::chrono::steady_clock::now(), deadline);
            const unsigned compiled = fresh.programs().compiled;
            EXPECT_GT(compiled, 0u);
            fresh.draw(texture, turnedView(40, 40, {32, 32}, 0.6, 0.3), output);
            EXPECT_EQ(fresh.programs().compiled, compiled);
        }
}

TEST_F(WarmUp, PicturesNeedNotWaitForIt) {
    RendererOptions options;
    options.pixels = Pixels::Shaders;
    Renderer warm(options), cold(options);
    const asset::View view = turnedView(40, 40, {32, 32}, 0.6, 0.3);
    const Texture texture = warm.upload(layers());
    warm.warmUp(texture);
    EXPECT_EQ(warm.renderBitmap(texture, view).rgba, cold.renderBitmap(cold.upload(layers()), view).rgba);
}

TEST_F(Gl, TexturesBeyondTheDriversLimitAreAnError) {
    EXPECT_THROW(makeTexture(GL_RGBA8, limit(GL_MAX_TEXTURE_SIZE) + 1, 1), GlError);
}

TEST_F(Gl, PendingErrorsAreNamed) {
    glEnable(0x1234);
    try {
        checkErrors("here");
        ADD_FAILURE();
    } catch (const GlError& error) {
        EXPECT_STREQ(error.what(), "here: GL says invalid enum (0x0500)");
    }
}

TEST(Features, AreThoseOfThePrograms) {
    EXPECT_EQ(featuresOf(disc()).flags(), 0u);
    EXPECT_EQ(featuresOf(layers()).flags(), Features::Linear);
    EXPECT_EQ(featuresOf(blendAsset(asset::Blend::Normal)).flags(),
              Features::Linear | Features::Radial | Features::Groups);
    EXPECT_EQ(featuresOf(blendAsset(asset::Blend::Hue)).flags(),
              Features::Linear | Features::Radial | Features::Groups | Features::Mixing);
    EXPECT_EQ(featuresOf(everyPaint()).flags(), Features::combinations - 1 - Features::LongRamps);
}

TEST(Shelves, PlaceWithoutOverlapUntilFull) {
    constexpr int side = 100;
    Shelves shelves({side, side});
    std::vector<int> owner(side * side, -1);
    int placed = 0;
    for (;; ++placed) {
        const glm::ivec2 size(1 + placed * 7 % 23, 1 + placed * 5 % 19);
        const std::optional<glm::ivec2> corner = shelves.place(size);
        if (!corner)
            break;
        for (int y = corner->y; y < corner->y + size.y; ++y)
            for (int x = corner->x; x < corner->x + size.x; ++x)
                EXPECT_EQ(std::exchange(owner.at(std::size_t(y * side + x)), placed), -1);
        EXPECT_LE(corner->y + size.y, shelves.height());
    }
    EXPECT_GT(placed, 40);
    shelves.clear();
    EXPECT_EQ(shelves.place({side, side}), glm::ivec2(0));
    EXPECT_EQ(shelves.place({1, 1}), std::nullopt);
}

}  // namespace

// Programs on disk: found again, never trusted further than they link.

namespace {

namespace fs = std::filesystem;

const asset::View view = turnedView(40, 40, {32, 32}, 0.6, 0.3);

class ProgramCacheTest : public Gl {
protected:
    void SetUp() override {
        Gl::SetUp();
        if (!context)
            return;
        if (limit(GL_NUM_PROGRAM_BINARY_FORMATS) == 0)
            GTEST_SKIP() << "the driver has no program binaries";
    }

    struct Drawn {
        std::vector<float> picture;
        ProgramFigures programs;
    };
    /// Every kind of program, in a new renderer.
    Drawn draw() {
        RendererOptions options;
        options.pixels = Pixels::Shaders;
        options.programCache = folder.string();
        Renderer fresh(options);
        Drawn drawn;
        for (const asset::Asset& asset : {everyPaint(), layers(), disc()}) {
            const image::Raster raster = fresh.render(fresh.upload(asset), view);
            drawn.picture.insert(drawn.picture.end(), raster.rgba.begin(), raster.rgba.end());
        }
        drawn.programs = fresh.programs();
        return drawn;
    }
    std::vector<fs::path> files() const {
        std::vector<fs::path> list;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder))
            list.push_back(entry.path());
        return list;
    }

    const TestFolder parent;
    const fs::path folder = parent / "made";
};

TEST_F(ProgramCacheTest, WhatIsKeptIsNotCompiled) {
    const Drawn cold = draw();
    EXPECT_EQ(cold.programs.compiled, cold.programs.made);
    EXPECT_EQ(files().size(), cold.programs.made);
    const Drawn warm = draw();
    EXPECT_EQ(warm.programs.made, cold.programs.made);
    EXPECT_EQ(warm.programs.compiled, 0u);
    EXPECT_EQ(warm.picture, cold.picture);
}

TEST_F(ProgramCacheTest, WhatIsDamagedIsCompiled) {
    const Drawn cold = draw();
    int i = 0;
    for (const fs::path& file : files()) {
        const auto size = fs::file_size(file);
        switch (i++ % 4) {
            case 0:
                fs::resize_file(file, size / 2);
                break;
            case 1:
                fs::resize_file(file, 0);
                break;
            case 2: {  // a byte of the driver's
                std::fstream damaged(file, std::ios::in | std::ios::out | std::ios::binary);
                damaged.seekp(std::streamoff(size - 9));
                damaged.put('?').put('?');
                break;
            }
            default: {  // foreign
                std::ofstream(file, std::ios::binary)
                    << "nothing of ours, but longer than a header is, by far";
            }
        }
    }
    const Drawn again = draw();
    EXPECT_EQ(again.programs.compiled, cold.programs.made);
    EXPECT_EQ(again.picture, cold.picture);
    EXPECT_EQ(draw().programs.compiled, 0u);  // mended
}

/// Whole by its checksum, yet not what the driver takes.
TEST_F(ProgramCacheTest, WhatDoesNotLinkIsCompiled) {
    const Drawn cold = draw();
    const std::vector<fs::path> list = files();
    for (const fs::path& file : list) {
        std::fstream damaged(file, std::ios::in | std::ios::out | std::ios::binary);
        damaged.seekp(24);  // Header::format
        damaged.write("\x01\x02\x03\x04", 4);
    }
    EXPECT_EQ(draw().programs.compiled, cold.programs.made);
}

TEST_F(ProgramCacheTest, PlacesThatCannotBeWrittenDoNoHarm) {
    fs::create_directories(folder.parent_path());
    std::ofstream(folder) << "a file where the directory would be";
    const Drawn drawn = draw();
    EXPECT_EQ(drawn.programs.compiled, drawn.programs.made);
}

/// Start-up, as a count: an exact picture of solid colours or of programs, whatever it shows.
TEST_F(ProgramCacheTest, APictureTakesFewPrograms) {
    for (const asset::Asset& asset : {everyPaint(), disc(), twoLevels()}) {
        Renderer fresh;
        const Texture texture = fresh.upload(asset);
        fresh.render(texture, view);
        fresh.render(texture, turnedView(40, 40, {32, 32}, 7, 1));
        EXPECT_LE(fresh.programs().made, 3u);
    }
}

}  // namespace

}  // namespace vtm::gl
