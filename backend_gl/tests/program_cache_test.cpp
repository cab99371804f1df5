// Programs on disk: found again, never trusted further than they link.
#include <filesystem>
#include <fstream>

#include <unistd.h>

#include <fmt/format.h>

#include "asset/testing.hpp"
#include "backend_gl/core/gl.hpp"
#include "backend_gl/tests/gl_fixture.hpp"
#include "raster/testing_views.hpp"

namespace vtm::gl {
namespace {

using namespace asset::test;
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
        fs::remove_all(folder);
    }
    void TearDown() override { fs::remove_all(folder.parent_path()); }

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

    /// A process' own: tests run side by side.
    const fs::path folder =
        fs::path(testing::TempDir()) / fmt::format("vtm_program_cache_{}", getpid()) / "made";
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
